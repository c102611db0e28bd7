-- The folder ../shared/reference/meshes; false, and a word about that, where it is not there.
local folder <const> = debug.getinfo(1, "S").source:match "^@(.*)/" .. "/../../../shared/reference/meshes/"
local f <const> = io.open(folder .. "README.md")
if not f then print "skipped: no ../shared/reference/meshes" return false end
f:close()
return folder
