-- scripts/papers/README.md says where each formula of the sources is: every file that it names is there, no cell of its tables is empty, no two rows are
-- equal, and every script that a table names (of scripts/lib aside) runs as a test of tests/CMakeLists.txt.
local root <const> = debug.getinfo(1, "S").source:match "^@(.*)/tests/script/" or "."
local page <const> = assert(io.open(root .. "/scripts/papers/README.md")):read "a"

local named, missing = 0, {}
for path in page:gmatch "`([%w_/]+%.%w+)[^`]*`" do
  local folder <const>, kind <const> = path:match "^(%w+)/", path:match "%.(%w+)$"
  if folder and ({ scripts = true, tests = true, src = true, images = true })[folder] and ({ lua = true, cpp = true, hpp = true, png = true })[kind] then
    named = named + 1
    local file <const> = io.open(root .. "/" .. path)
    if file then file:close() else missing[#missing + 1] = path end
  end
end
assert(named > 300, named)
assert(#missing == 0, "not there: " .. table.concat(missing, ", "))

-- dotyk_script_test(NAME …), also in the body of a foreach(VARIABLE ITEMS), where NAME holds ${VARIABLE}.
local lists <const> = assert(io.open(root .. "/tests/CMakeLists.txt")):read "a":gsub("#[^\n]*", "")
local tested, tests = {}, 0
local function test(name)
  if not name:find("${", 1, true) and not tested[name] then tested[name], tests = true, tests + 1 end
end
local function tests_of(text, variable, item)
  for name in text:gmatch "dotyk_script_test%(([^%s)]+)" do test((name:gsub("%${" .. (variable or "") .. "}", item or "%0"))) end
end
for variable, items, body in lists:gmatch "foreach%((%S+)%s+([^)]*)%)(.-)endforeach" do
  for item in items:gmatch "%S+" do tests_of(body, variable, item) end
end
tests_of(lists)
assert(tests > 80 and tested["tutorial/01_a_body"], tests)

local rows, seen, untested = 0, {}, {}
for line in page:gmatch "[^\n]+" do
  if line:find "^|" and not line:find "^|[-| ]+$" then
    rows = rows + 1
    assert(line:find "^| in the source " or line:find "^| question " or not seen[line], "twice: " .. line)
    seen[line] = true
    local first <const>, rest <const> = line:match "^|([^|]*)|(.*)|%s*$"
    assert(rest, line)
    for cell in (rest:gsub("\\|", "") .. "|"):gmatch "([^|]*)|" do assert(cell:find "%S" or first:find "^%s*$", "an empty cell: " .. line) end
    for script in line:gmatch "scripts/([%w_/]+)%.lua" do
      if not script:find "^lib/" and not tested[script] then untested[#untested + 1] = script end
    end
  end
end
assert(rows > 400, rows)
assert(#untested == 0, "no dotyk_script_test runs: " .. table.concat(untested, ", "))
