-- Files are written whole or not at all, and a path that cannot be written is an error at the line.
local check <const> = require "check"
local refused <const> = require "refused"

local it <const> = refused.pressed_block()
local s <const> = it.solve()
refused.intact = it.solve

local folder <const> = os.tmpname()
os.remove(folder)
assert(os.execute("mkdir '" .. folder .. "'"))
local function files()
  local listing = assert(io.popen("ls -A '" .. folder .. "'"))
  local text = listing:read "a"
  listing:close()
  return text
end
local function exists(file)
  local handle = io.open(file)
  return handle ~= nil and handle:close()
end
local nowhere <const> = folder .. "/nowhere/"
local curve <const> = { { x = { 1, 2 }, y = { 1, 2 } } }

-- A folder that does not exist.
refused(function() s:render{ file = nowhere .. "a.png" } end, "render: cannot write '" .. nowhere .. "a.png'", "No such file or directory")
refused(function() dotyk.chart{ file = nowhere .. "a.png", series = curve } end, "chart: cannot write '" .. nowhere .. "a.png'")
refused(function() s:write(nowhere .. "a.vtu") end, "write: cannot write '" .. nowhere .. "a.vtu'", "No such file or directory")
refused(function() s:write_contact(nowhere .. "a.csv") end, "write_contact: cannot write '" .. nowhere .. "a.csv'", "No such file or directory")
-- A folder in place of the file.
for _, name in ipairs{ "a.png", "a.vtu", "a.csv" } do assert(os.execute(("mkdir '%s/%s'"):format(folder, name))) end
local before <const> = files()
refused(function() s:render{ file = folder .. "/a.png" } end, "it is a folder")
refused(function() s:write(folder .. "/a.vtu") end, "it is a folder")
refused(function() s:write_contact(folder .. "/a.csv") end, "it is a folder")
check.equal(files(), before)
-- Another ending, no name at all.
refused(function() s:render{ file = folder .. "/b.jpg" } end, "must end in .png, .pdf or .svg")
refused(function() dotyk.chart{ file = folder .. "/b.eps", series = curve } end, "must end in .png, .pdf or .svg")
refused(function() dotyk.chart{ file = folder .. "/b.pdf", series = curve, width = 8 } end, "'width' is 8 mm; it must be from 30 to 500")
refused(function() s:write(folder .. "/b.vtk") end, "must end in .vtu")
refused(function() s:write "" end, "a file name is needed, one that ends in .vtu")
refused(function() s:write_contact "" end, "a file name is needed")
refused(function() s:render{} end, "missing key 'file'")
refused(function() s:render(7) end, "expected a table of keys (file, ")
refused(function() s:write() end, "argument 1 'file' is missing, expected a string")
refused(function() s:write{ file = "b.vtu" } end, "argument 1 'file' must be a string, got a table")

-- What is drawn.
local file <const> = folder .. "/c.png"
refused(function() s:render{ file = file, field = "vonmises" } end, "did you mean \"von_mises\"?")
refused(function() s:render{ file = file, field = "uz" } end, "does not exist: the scene is 2-D")
refused(function() s:render{ file = file, deform = "big" } end, "'deform' must be a number or \"auto\", got the string \"big\"")
refused(function() s:render{ file = file, deform = -1 } end, "deform is -1")
refused(function() s:render{ file = file, deform = 0/0 } end, "finite")
refused(function() s:render{ file = file, size = { 10, 800 } } end, "160 to 8192")
refused(function() s:render{ file = file, size = { 800 } } end, "'size' must be a table of 2 integers, got a table of 1")
refused(function() s:render{ file = file, range = { 1, 0 } } end, "{least, greatest}")
refused(function() s:render{ file = file, colour = "red" } end, "unknown key 'colour'")
refused(function() dotyk.chart{ file = file, series = { { x = { 1, 2 }, y = { 1 } } } } end, "2 x and 1 y")
refused(function() dotyk.chart{ file = file, series = { { x = { 1, 0/0 }, y = { 1, 2 } } } } end, "entry 2 must be a finite number, got nan")
refused(function() s:render{ file = file, view = { 0, 0, 1 } } end, "'view' is for scenes in space; this one is 2-D")
refused(function() dotyk.chart{ file = file, series = {} } end, "'series' must be a table of at least 1 item")
refused(function() dotyk.chart{ file = file } end, "missing key 'series'")
refused(function() dotyk.chart{ file = file, series = { { x = { 1 }, y = { 1 }, colour = 1 } } } end, "'series': entry 1: unknown key 'colour'")
check.that(not exists(file))
check.equal(files(), before)

-- What can be written is, under its own name and no other.
s:render{ file = file, size = { 320, 240 } }
s:write(folder .. "/c.vtu")
s:write_contact(folder .. "/c.csv")
for _, name in ipairs{ "c.png", "c.vtu", "c.csv" } do check.that(exists(folder .. "/" .. name), name) end
check.equal(select(2, files():gsub("\n", "\n")), 6)
os.execute("rm -r '" .. folder .. "'")
