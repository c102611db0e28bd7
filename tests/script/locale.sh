#!/bin/bash
# Where numbers are written with a comma (LC_ALL=cs_CZ.UTF-8), dotyk reads and writes them with a point: scripts,
# files, the prompt. Skipped where that locale cannot be made.
typist=$(realpath "$2")
. "$(dirname "$0")/scratch.sh"
command -v localedef >/dev/null && localedef -i cs_CZ -f UTF-8 "$folder/cs_CZ.UTF-8" 2>/dev/null && export LOCPATH=$folder
{ export LC_ALL=cs_CZ.UTF-8; } 2>/dev/null # this shell itself may be too late for it
export HOME=$folder TERM=xterm
unset XDG_STATE_HOME
[[ $("$dotyk" -e 'print(os.setlocale "cs_CZ.UTF-8", 0.5)') == cs_CZ.UTF-8*0,5 ]] || exit 77

cat >half.qps <<'QPS'
NAME half
ROWS
 N obj
 G low
COLUMNS
 x obj 0.5 low 1.0
RHS
 rhs low 1.5
QUADOBJ
 x x 2.5
ENDATA
QPS
cat >numbers.lua <<'LUA'
assert(tostring(0.5) == "0.5" and tonumber "2.5" == 2.5 and ("%g"):format(0.25) == "0.25")
local mesh <const> = dotyk.mesh.rectangle{ from = {0,0}, to = {1.5,1}, cells = {2,2} }
local block <const> = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 1.5, nu = 0.3 } }
block:part"bottom":fix()
block:part"top":load{ 0.5, -0.25 }
local scene <const> = dotyk.scene{ block }
scene:contact{ block:part"right", rigid = dotyk.rigid.gap{ normal = {1,0}, gap = 0.125 } }
local s <const> = dotyk.solve(scene)
local function written(name)
  s:write(name .. ".vtu")
  s:write_contact(name .. ".csv")
  local texts = {}
  for k, kind in ipairs{ ".vtu", ".csv" } do
    local file <close> = assert(io.open(name .. kind, "rb"))
    texts[k] = file:read "a"
  end
  return texts
end
local before <const> = written "before"
assert(before[2]:find("1.5,0.5,", 1, true), "coordinates in the table")
s:render{ file = "picture.png" } -- opens the drawing library
assert(tostring(0.5) == "0.5")
-- A script that asks for commas has them in its own texts; files keep their points, whichever way they go.
assert(os.setlocale "cs_CZ.UTF-8")
local after <const> = written "after"
assert(before[1] == after[1] and before[2] == after[2])
local r <const> = dotyk.qp "half.qps":solve{}
assert(r.converged and math.abs(r.objective - (0.5 * 1.5 + 2.5 * 1.5^2 / 2)) < 1e-12, r.objective)
LUA
"$dotyk" --traceback numbers.lua || exit 1

terminals || exit 0
screen=$("$typist" "$dotyk" '0.25 + 0.5\n')
grep -qF 0.75 <<<"$screen" || { echo "the prompt shows no 0.75:"; echo "$screen"; exit 1; }
