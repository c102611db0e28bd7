-- Was dotyk built without Gmsh's library? Says so, once.
local ok <const>, message <const> = pcall(dotyk.mesh.gmsh, { text = "" })
local absent <const> = not ok and message:find("built without Gmsh", 1, true) ~= nil
if absent then print("skipped: dotyk was built without Gmsh's library") end
return absent
