# Seeds of the fuzzers that coverage guides, from FROM's tests and tutorial into TO/text and TO/script.
file(MAKE_DIRECTORY ${TO}/text ${TO}/script)
file(GLOB scripts ${FROM}/tests/fuzz/corpus/*.lua ${FROM}/scripts/tutorial/*.lua)
file(COPY ${scripts} DESTINATION ${TO}/script)

# Before a file stands the number of its reader: see libfuzzer_text.cpp.
foreach(kind 0.mesh 1.qps 2.lcp 3.fc)
  string(REGEX MATCH "^([0-9]).(.*)$" both ${kind})
  set(number ${CMAKE_MATCH_1})
  file(GLOB files ${FROM}/tests/fuzz/files/*.${CMAKE_MATCH_2})
  foreach(one IN LISTS files)
    get_filename_component(name ${one} NAME)
    file(READ ${one} text)
    file(WRITE ${TO}/text/${name} "${number}${text}")
  endforeach()
endforeach()
