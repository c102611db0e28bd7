#!/bin/bash
# Where results are written: through links to what they lead to, and nowhere but to files, by each of the writers.
. "$(dirname "$0")/scratch.sh"
cat >writers.lua <<'LUA'
local mesh <const> = dotyk.mesh.rectangle{ from = {0,0}, to = {2,1}, cells = {8,4} }
local block <const> = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 100, nu = 0.3 } }
block:part "left":fix "x"
block:part "top":load{ 0, -1 }
local scene <const> = dotyk.scene{ block }
scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }
local s <const> = dotyk.solve(scene)
local shape <const> = dotyk.shape{ scene = scene, objective = "peak_pressure",
  moves = { { part = block:part "bottom", control_points = 4, direction = {0,1}, lower = -0.05, upper = 0.05 } } }
return {
  csv = function(file) s:write_contact(file) end,
  vtu = function(file) s:write(file) end,
  png = function(file) s:render{ file = file } end,
  lua = function(file) shape:optimise{ max_designs = 1, file = file } end }
LUA
cat >refused.lua <<'LUA'
-- refused.lua FOLDER NAME REASON: each writer is refused at that name with its ending.
for ending, write in pairs(dofile "writers.lua") do
  local file <const> = ("%s/%s.%s"):format(arg[1], arg[2], ending)
  local ok <const>, message <const> = pcall(write, file)
  if ok or not message:find("^writers.lua:%d+: [a-z_]+: cannot write '" .. file .. "': it " .. arg[3] .. "; results are written to files$") then
    error(file .. ": " .. tostring(message))
  end
end
LUA
endings='csv vtu png lua'
# linked FROM TO: two folders; of each ending a link to a file, FROM/a, and one to none, FROM/new.
linked() {
  mkdir "$1" "$2"
  for e in $endings; do
    echo old >"$2/a.$e"
    ln -s "../$2/a.$e" "$1/a.$e"
    ln -s "../$2/new.$e" "$1/new.$e"
  done
}
mkdir t
for e in $endings; do
  mkfifo t/pipe.$e
  ln -s pipe.$e t/link.$e
  mkdir t/folder.$e
done
before=$(ls -lA t)
"$dotyk" refused.lua t pipe 'is a pipe' || fail "a pipe"
"$dotyk" refused.lua t link "leads to '.*/t/pipe.[a-z]+', a pipe" || fail "a link to a pipe"
"$dotyk" refused.lua t folder 'is a folder' || fail "a folder"
[[ $(ls -lA t) == "$before" ]] || fail "what is no file has changed: $(ls -lA t)"

if mknod node c 1 7 2>/dev/null; then # a node of our own, never the system's
  rm node
  mkdir d
  for e in $endings; do mknod d/full.$e c 1 7; done
  before=$(ls -lA d)
  "$dotyk" refused.lua d full 'is a device' || fail "a device"
  [[ $(ls -lA d) == "$before" ]] || fail "a device has changed: $(ls -lA d)"
else
  echo "no device can be made here: left out"
fi

# Links: what they lead to is replaced, or made; they stay.
linked l m
"$dotyk" -e 'for ending, write in pairs(dofile "writers.lua") do write("l/a." .. ending) write("l/new." .. ending) end' || fail "links"
for e in $endings; do
  [[ -L l/a.$e && -L l/new.$e && -f m/a.$e && -s m/a.$e && -f m/new.$e && $(<m/a.$e) != old ]] 2>/dev/null || fail "links of .$e: $(ls -lA l m)"
done
[[ $(ls -A l m | grep -c .) == 18 ]] || fail "something stays beside: $(ls -A l m)"

# What leads out of the folder of --safe stays refused. Behind the kernel's rule for the folder the leak sanitizer cannot read its list.
linked below outside
cp writers.lua below
ASAN_OPTIONS=detect_leaks=0 "$dotyk" --safe below -e 'for ending, write in pairs(dofile "below/writers.lua") do
  for _, name in ipairs{ "below/a.", "below/new." } do
    local ok, message = pcall(write, name .. ending)
    if ok or not message:find("is not below", 1, true) then error(name .. ending .. ": " .. tostring(message)) end
  end
end' || fail "--safe"
[[ $(ls outside) == $'a.csv\na.lua\na.png\na.vtu' && $(cat outside/*) == $'old\nold\nold\nold' ]] || fail "--safe: something outside has changed"

exit $((failures > 0))
