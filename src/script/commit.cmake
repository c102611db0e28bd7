cmake_minimum_required(VERSION 3.25)
# Writes the header FILE with the commit of the checkout SOURCE, where there is one; touches it only when that changes.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=40 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT EXISTS ${SOURCE}/.git)
  set(commit "not built from a checkout")
endif()
file(CONFIGURE OUTPUT ${FILE} CONTENT "#pragma once\ninline constexpr char commit[] = \"@commit@\";\n" @ONLY)
