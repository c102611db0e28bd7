#!/bin/bash
# dotyk --manifest: beside every figure and result the lines that tell where it comes from; nothing without it.
. "$(dirname "$0")/scratch.sh"
cat >block.lua <<'LUA'
local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} }, material = dotyk.material{ E = 1 } }
b:part "left":fix()
b:part "top":load{ 0, -0.1 }
local scene = dotyk.scene{ b }
scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }
local s = dotyk.solver.pdas{ rho = 2, tol = 1e-9 }:solve(scene)
s:render{ file = "block.png" }
s:write "block.vtu"
s:write_contact "block.csv"
dotyk.chart{ file = "chart.png", series = { { x = {0,1}, y = {0,1} } } }
LUA
"$dotyk" block.lua || fail "without"
[[ $(ls) == $'block.csv\nblock.lua\nblock.png\nblock.vtu\nchart.png' ]] || fail "unasked: $(ls)"
"$dotyk" --manifest block.lua 7 'two words' || fail "with"
[[ $(ls | grep -v manifest) == $'block.csv\nblock.lua\nblock.png\nblock.vtu\nchart.png' ]] || fail "$(ls)"
for file in block.csv block.png block.vtu chart.png; do
  m=$file.manifest
  [[ -f $m ]] || { fail "no $m"; continue; }
  grep -qx "file: $file" "$m" || fail "$m: file"
  grep -qx 'script: block.lua' "$m" || fail "$m: script"
  grep -qx "script sha256: $(sha256sum <block.lua | cut -d' ' -f1)" "$m" || fail "$m: hash"
  [[ $(grep -x 'argument: .*' "$m") == $'argument: 7\nargument: two words' ]] || fail "$m: arguments"
  grep -qx "dotyk: $("$dotyk" --version | cut -d' ' -f2)" "$m" || fail "$m: version"
  grep -qEx 'commit: ([0-9a-f]{40}(-dirty)?|not built from a checkout)' "$m" || fail "$m: commit"
  grep -qEx "cores: $(nproc --all)" "$m" || grep -qEx 'cores: [1-9][0-9]*' "$m" || fail "$m: cores"
  grep -qEx 'processor: .+' "$m" || fail "$m: processor"
  grep -qEx "date: $(date -u +%Y-%m-%d)T[0-9:]{8}Z" "$m" || fail "$m: date"
  grep -qEx 'seconds: [0-9.e-]+' "$m" || fail "$m: seconds"
done
grep -qx 'call: solution:render' block.png.manifest || fail "call"
grep -qx 'solver: .*pdas.*rho = 2.*tol = 1e-09.*' block.png.manifest || fail "solver: $(<block.png.manifest)"
grep -qx 'solution converged: true' block.vtu.manifest || fail "solution: $(<block.vtu.manifest)"
grep -q '^sol' chart.png.manifest && fail "a chart has no solution"

# Where it cannot be written the script's line says so.
mkdir chart.png.manifest.d && rm chart.png.manifest && mv chart.png.manifest.d chart.png.manifest
got=$("$dotyk" --manifest block.lua 2>&1)
[[ $? == 1 && $got == "dotyk: block.lua:10: chart: cannot write 'chart.png.manifest': "* ]] || fail "a folder in its place: $got"
rm chart.png
"$dotyk" --manifest block.lua 2>/dev/null
[[ ! -e chart.png ]] || fail "a chart without its manifest"

# A script from standard input has its hash too; what Lua skips of a file is skipped.
printf '#!/usr/bin/dotyk\n%s' "$(<block.lua)" >piped.lua
rm -r chart.png.manifest
"$dotyk" --manifest - <piped.lua || fail "from standard input"
grep -qx "script sha256: $(sha256sum <piped.lua | cut -d' ' -f1)" chart.png.manifest || fail "standard input: $(<chart.png.manifest)"
grep -qx 'script: standard input' chart.png.manifest || fail "standard input: name"
got=$(printf '#!/usr/bin/dotyk\nerror "here"' | "$dotyk" --manifest - 2>&1)
[[ $? == 1 && $got == "dotyk: stdin:2: here" ]] || fail "standard input: line: $got"

# A manifest is below the folder too, as its file is, and a link in its place may not lead out.
mkdir below && echo kept >outside.txt && ln -s ../outside.txt below/x.png.manifest
# Behind the kernel's rule for the folder the leak sanitizer cannot read its list.
got=$(ASAN_OPTIONS=detect_leaks=0 "$dotyk" --manifest --safe below -e 'dotyk.chart{ file = "below/x.png", series = { { x = {0,1}, y = {0,1} } } }' 2>&1)
[[ $? == 1 && $got == "dotyk: -e:1: chart: 'below/x.png.manifest' is not below 'below', the folder of this run (--safe)" && $(<outside.txt) == kept ]] || fail "a link in its place: $got"
rm below/x.png.manifest && ln -s y.manifest below/x.png.manifest
ASAN_OPTIONS=detect_leaks=0 "$dotyk" --manifest --safe below -e 'dotyk.chart{ file = "below/x.png", series = { { x = {0,1}, y = {0,1} } } }' || fail "--safe"
grep -q '^call: dotyk.chart$' below/y.manifest && [[ -L below/x.png.manifest ]] || fail "a link within the folder"

exit $((failures > 0))
