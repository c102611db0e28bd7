-- Files that are no meshes, or broken ones: one line that names the file, at the user's line, and nothing else happens.
local check <const> = require "check"
local refused <const> = require "refused"
local folder <const> = debug.getinfo(1, "S").source:match "^@(.*)/" .. "/files/"

local it <const> = refused.pressed_block()
refused.intact = it.solve

local function file(name, content)
  local f <const> = assert(io.open(name, "wb"))
  f:write(content)
  f:close()
  return name
end
local function expect(name, content, ...)
  if content then file(name, content) end
  local message <const> = refused(function() dotyk.mesh.load(name) end, "load: ", ...)
  check.that(not message:find "\n", message)
  if content then os.remove(name) end
end

expect("nothing.msh", nil, "cannot read 'nothing.msh': No such file or directory")
expect("nothing.mesh", nil, "cannot read 'nothing.mesh': No such file or directory")
expect("nothing.vtu", nil, "cannot read 'nothing.vtu': No such file or directory")
expect("mesh.stl", nil, "'mesh.stl' does not end in .msh (Gmsh), .mesh (MFEM) or .vtu (VTK)")
expect("", nil, "'' does not end in")
expect("a\0.msh", nil, "zero byte")
expect("part.geo", nil, 'dotyk.mesh.gmsh{ file = "part.geo" }')
for _, ending in ipairs{ ".msh", ".mesh", ".vtu" } do
  expect("empty" .. ending, "", "it is empty")
  expect("noise" .. ending, string.rep("\1\200\0x", 99), "noise" .. ending .. ": ")
  os.execute("mkdir -p folder" .. ending)
  expect("folder" .. ending, nil, "it is a folder")
  os.execute("rmdir folder" .. ending)
  os.execute("mkfifo pipe" .. ending)  -- opening it would wait for ever
  expect("pipe" .. ending, nil, "it is not a file")
  os.remove("pipe" .. ending)
end
refused(function() dotyk.mesh.load() end, "file")
refused(function() dotyk.mesh.load(3) end, "file")
refused(function() dotyk.mesh.load("a.msh", { regoin = "a" }) end, "unknown key 'regoin', did you mean 'region'?")
refused(function() dotyk.mesh.load("a.msh", { region = 3 }) end, "region")
refused(function() dotyk.mesh.load("a.msh", { region = { 3 } }) end, "region")
for _, order in ipairs{ 0, 3, 1.5, "2" } do refused(function() dotyk.mesh.load("a.msh", { order = order }) end, "order") end

-- What does not begin as a mesh is none, and nothing in it is run.
expect("script.msh", 'SystemCall "touch ran";\n', "it does not begin with $MeshFormat")
expect("script.msh", '$Script\n$MeshFormat\n2.2 0 8\n$EndMeshFormat\nSystemCall "touch ran";\n', "it does not begin with $MeshFormat")
expect("script.msh", ' $MeshFormat\n2.2 0 8\n$EndMeshFormat\nSystemCall "touch ran";\n', "it does not begin with $MeshFormat")
check.that(not io.open "ran")
expect("header.msh", "$Nodes\n", "it does not begin with $MeshFormat")
expect("old.msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n", "version 1; save it as version 4.1 or 2.2")
for _, version in ipairs{ "1", "2.3", "3", "4.2", "5", "-2.2", "1e9" } do
  expect("version.msh", "$MeshFormat\n" .. version .. " 0 8\n$EndMeshFormat\n", "mesh of version " .. version, "2.0 to 2.2, 4.0 and 4.1 are read")
end
expect("version.msh", "$MeshFormat\nx 0 8\n$EndMeshFormat\n", "'x' where the version of the Gmsh mesh should be")

expect("header.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "it holds no cells")

-- What lies beside a mesh is not read, though Gmsh takes FILE.opt for commands.
local commands <const> = 'SystemCall "touch ran";\nPrintf("x") > "written";\nSave "saved.msh";\nMesh.MeshSizeMax = 1e-3;\n'
local triangle <const> = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n"
file("x.msh.opt", commands)
check.equal(dotyk.mesh.load(file("x.msh", triangle)).cell_count, 1)
expect("x.msh", triangle:gsub("1 2 3\n", "1 2 4\n"), "x.msh, line 12: node 4 of an element is not there")
os.remove "x.msh.opt"
check.that(not io.open "ran" and not io.open "written" and not io.open "saved.msh")
local f <const> = assert(io.open(folder .. "triangles_41.msh"))
local text <const> = f:read "a"
f:close()
refused(function() dotyk.mesh.load(folder .. "triangles_41.msh", { region = "top" }) end,
        "there is no region 'top' (a boundary part has that name); regions: 'left half', 'right half'")
refused(function() dotyk.mesh.load(folder .. "triangles_41.msh", { region = { "left half", "both" } }) end, "there is no region 'both'")
expect("cut.msh", text:sub(1, 700), "cut.msh, line ")
expect("cut.msh", text:sub(1, 1200), "cut.msh, line ")
expect("nan.msh", (text:gsub("0.5", "nan")), "nan.msh")
-- Counts that no file of this length can hold end in an error, not in all memory being used.
local clock <const> = os.time()
expect("huge.msh", (text:gsub("%$Elements\n%d+ %d+ ", "$Elements\n4000000000 4000000000 ")), "the file is too short for that")
expect("huge.msh", (text:gsub("%$Nodes\n%d+ %d+ ", "$Nodes\n9999999999 9999999999 ")), "the file is too short for that")
check.that(os.time() - clock < 20)

if require "without_gmsh" then return end
-- A geometry, which is a script, describes no more than a geometry.
local square <const> = "Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {0,1,0}; Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,1}; Curve Loop(1) = {1,2,3}; Plane Surface(1) = {1};\n"
check.that(dotyk.mesh.gmsh{ text = square, size = 1 }.cell_count > 0)
refused(function() dotyk.mesh.gmsh{ text = square .. 'SystemCall "touch ran";\n', size = 1 } end, "gmsh: geometry: Gmsh: ")
for _, command in ipairs{ 'Printf("x") > "written";\n', 'Save "saved.msh";\n' } do pcall(dotyk.mesh.gmsh, { text = square .. command, size = 1 }) end
check.that(not io.open "ran" and not io.open "written" and not io.open "saved.msh")
