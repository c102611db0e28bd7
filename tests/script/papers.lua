-- scripts/papers/README.md says where each formula of the sources is: every file that it names is there, and no cell of its tables is empty.
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

local rows = 0
for line in page:gmatch "[^\n]+" do
  if line:find "^|" and not line:find "^|[-| ]+$" then
    rows = rows + 1
    local first <const>, rest <const> = line:match "^|([^|]*)|(.*)|%s*$"
    assert(rest, line)
    for cell in (rest:gsub("\\|", "") .. "|"):gmatch "([^|]*)|" do assert(cell:find "%S" or first:find "^%s*$", "an empty cell: " .. line) end
  end
end
assert(rows > 400, rows)
