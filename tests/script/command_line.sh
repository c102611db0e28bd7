#!/bin/bash
# The program from the outside: ways to start it, what it prints where, exit status.
. "$(dirname "$0")/scratch.sh"

# expect NAME STATUS STDOUT STDERR COMMAND…: standard input is empty.
expect() {
  local name=$1 status=$2 out=$3 err=$4
  shift 4
  "$@" >out.txt 2>err.txt </dev/null
  local got=$?
  [[ $got == "$status" && $(<out.txt) == "$out" && $(<err.txt) == "$err" ]] && return
  fail "$name: status $got (expected $status)"
  diff <(echo "$out") out.txt
  diff <(echo "$err") err.txt
}

echo 'print("hello", arg[0], ...) return 3' >hello.lua
printf 'local x = 1\nprint(x)\nerror("gone wrong")\n' >wrong.lua
printf 'local x = = 1\n' >syntax.lua
printf 'y = 7\n' >sets.lua
printf '\n\nerror({})\n' >table.lua
echo 'print(1)' >hello_.lua

expect "a script" 0 $'hello\thello.lua' '' "$dotyk" hello.lua
expect "arguments" 0 '2 a --b' '' "$dotyk" -e 'print(#arg .. " " .. arg[1] .. " " .. arg[2])' a --b
expect "-e" 0 '2' '' "$dotyk" -e 'print(1 + 1)'
expect "an error" 1 '1' 'dotyk: wrong.lua:3: gone wrong' "$dotyk" wrong.lua
expect "a syntax error" 1 '' "dotyk: syntax.lua:1: unexpected symbol near '='" "$dotyk" syntax.lua
expect "an error that is a table" 1 '' 'dotyk: table.lua:3: error with a table in place of a message' "$dotyk" table.lua
expect "an error without a message" 1 '' 'dotyk: -e:2: error with nil in place of a message' "$dotyk" -e $'\nerror()'
expect "a safe run that is none" 0 '1' "dotyk: --safe after the script is an argument of its own; dotyk's come before it" "$dotyk" hello_.lua --safe .
expect "an error of -e" 1 '' "dotyk: -e:1: unknown variable 'x'" "$dotyk" -e 'print(x)'
expect "a missing file" 2 '' 'dotyk: cannot open nothing.lua: No such file or directory' "$dotyk" nothing.lua
expect "an unknown option" 2 '' "dotyk: unknown option '--fast' (dotyk --help tells more)" "$dotyk" --fast
expect "-e without code" 2 '' 'dotyk: -e needs a text to run (dotyk --help tells more)' "$dotyk" -e
expect "-i without a file" 2 '' 'dotyk: -i needs a file (dotyk --help tells more)' "$dotyk" -i
expect "an empty prompt" 0 '' '' "$dotyk"
expect "os.exit" 5 '' '' "$dotyk" -e 'os.exit(5)'
expect "no home, odd locale" 0 '0.5' '' env -u HOME LC_ALL=de_DE.UTF-8 "$dotyk" -e 'print(0.5)'
expect "-" 0 $'12\tx' '' bash -c 'echo "print(12, arg[1])" | "$0" - x' "$dotyk"
expect "an error of -" 1 '' 'dotyk: stdin:2: no' bash -c 'printf "\nerror [[no]]\n" | "$0" -' "$dotyk"
expect "-i" 0 $'7' '' bash -c 'echo y | "$0" -i sets.lua' "$dotyk"
cat >keeps.lua <<'LUA'
#!/usr/bin/env dotyk
local n <const>, t = 3, { 5 }
local function f(x) return n * x end
print(select("#", ...))
LUA
expect "-i keeps the script's locals" 0 $'0\n3\n{ 5 }\n12\n-- keeps.lua:3\nlocal function f(x) return n * x end' '' \
  bash -c 'printf "%s\n" n t "f(4)" "f??" | "$0" -i keeps.lua' "$dotyk"
expect "-i after an error" 0 '1' 'dotyk: wrong.lua:3: gone wrong' bash -c 'echo x | "$0" -i wrong.lua | tail -n 1' "$dotyk"
expect "-i and a syntax error" 0 '' "dotyk: syntax.lua:1: unexpected symbol near '='" "$dotyk" -i syntax.lua
expect "-i -e" 0 '7' '' bash -c 'echo x | "$0" -i -e "local x <const> = 7"' "$dotyk"
expect "locals at the prompt" 0 $'3\n3\nnil\n9\n12\n1' 'prompt:1: oh' bash -c 'printf "%s\n" "local q <const> = 3" q "local a <const>, b = 1, 2" "a + b" "local z" z \
  "local function f(x)" "return x^2 // 1 | 0 end" "f(3)" "local c <const> = 5 local d <const> = 7" "c + d" "local k = 1 error [[oh]]" k | "$0"; exit 0' "$dotyk"
expect "a local that is shared" 0 $'2' '' bash -c 'printf "%s\n" "local n = 0 function up() n = n + 1 end" "up() up()" n | "$0"' "$dotyk"
expect "return" 0 $'5  6\n5' '' bash -c 'printf "%s\n" "return 5, 6" _ | "$0"' "$dotyk"
expect "a variable called as what Lua has" 0 $'{ 1 }\n{ 2 }' '' bash -c 'printf "%s\n" "local table, type = { 1 }, 5" table "{ 2 }" | "$0"' "$dotyk"
expect "help on a function typed, and its source" 0 $'A Lua function of 1 argument, written at prompt:1; source(f), or f??, shows it.\n-- prompt:1\nlocal function f(x)\n  return x^2\nend\n-- prompt:1\ng = function(x) local k <const> = 2 return k * x end' '' \
  bash -c 'printf "%s\n" "local function f(x)" "  return x^2" "end" "g = function(x) local k <const> = 2 return k * x end" "f?" "f??" "g??" | "$0"' "$dotyk"
expect "source of a text" 0 'this function was given as a text, which is not kept' '' "$dotyk" -e 'source(load "return 1")'
expect "globals that refuse a new one" 0 $'5\n7' '' bash -c 'printf "%s\n" "do setmetatable(_G, { __newindex = error }) end" 5 "_ + 2" | "$0"' "$dotyk"
expect "the prompt from a pipe" 1 $'3\n3\n{ 1, "x" }\n5' "prompt:1: unknown variable 'nix'" \
  bash -c 'printf "%s\n" "1 +" "2" "_" "local t = {" "1, [[x]] }" t "= 5" nix | "$0"' "$dotyk"
expect "a full disk" 1 '' 'dotyk: standard output could not be written: No space left on device' \
  bash -c '"$0" -e "print(1)" >/dev/full' "$dotyk"
expect "a closed output" 1 '' 'dotyk: standard output could not be written: Bad file descriptor' \
  bash -c '"$0" -e "print(1)" >&-' "$dotyk"
expect "a broken Lua folder" 1 '' "dotyk: the Lua files of dotyk, in /nowhere, cannot be loaded: cannot read /nowhere/init.lua" \
  env DOTYK_LUA=/nowhere "$dotyk" -e ''

"$dotyk" --version | grep -qx 'dotyk [0-9.]*' || fail "--version"
"$dotyk" --help | grep -q 'Exit status' || fail "--help"
# A function within itself, again and again: the place is said once.
nested=$("$dotyk" -e 'local m = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {1,1} }
local function within() m:transform(function(x, y) within() return x, y end) end within()' 2>&1)
[[ $nested == "dotyk: -e:2: C stack overflow (in 'map' of transform at -e:2)" ]] || fail "nested errors: ${nested:0:300}"
# What a logarithmic axis leaves out is said, once a chart.
expect "a logarithmic axis" 0 'a.png' "dotyk: a.png: zero and negative values have no place on a logarithmic axis; left out: 2 of 3 points of 'error', 1 of 2 points of series 3" \
  "$dotyk" -e 'print(dotyk.chart{ file = "a.png", log = "y", series = { { name = "error", x = {1,2,3}, y = {1,0,-1} }, { x = {0,1}, y = {1,2} }, { x = {0,1}, y = {0,2} } } })'
expect "a linear axis" 0 '' '' "$dotyk" -e 'dotyk.chart{ file = "a.png", series = { { x = {1,2}, y = {0,-1} } } }'

# A solution that is none is said to be so, once for a line of the script.
printf '%s\n' 'local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} }, material = dotyk.material{ E = 1 } }' \
  'b:part "top":load{ 0, -1 } b:part "left":fix "x"' 'local scene = dotyk.scene{ b }' \
  'scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }' \
  'local s for k = 2, 4 do s = dotyk.solver.psor{ max_iterations = k }:solve(scene) end' 'print(s.converged, tostring(s):match "NOT CONVERGED: [^\n]*")' \
  'dotyk.solve(scene) dotyk.solver.psor{ max_iterations = 1 }:solve(scene)' \
  'print(pcall(s.error_estimate, s))' \
  'local beam = dotyk.beam{ load = -1, left = { deflection = dotyk.law.signorini() }, right = { deflection = dotyk.law.signorini(), rotation = dotyk.law.friction(0.01) } }' \
  'dotyk.solver.psor{ max_iterations = 1 }:solve(beam)' >doubtful.lua
expect "solutions that are none" 0 $'false\tNOT CONVERGED: no convergence within 4 iterations (psor, 4 iterations); a method to try next: pdas
false\tdoubtful.lua:8: error_estimate: the solution has not converged, so that the error estimate, which is of a solution, does not apply (no convergence within 4 iterations; a method to try next: pdas)' \
  $'doubtful.lua:5: not converged (psor): no convergence within 2 iterations; a method to try next: pdas (said once for this line)
doubtful.lua:7: not converged (psor): no convergence within 1 iterations; a method to try next: pdas (said once for this line)
doubtful.lua:10: not converged (psor): no convergence within 1 iterations; a method to try next: pdas (said once for this line)' "$dotyk" doubtful.lua

"$dotyk" --traceback wrong.lua 2>&1 >/dev/null | grep -q 'stack traceback' || fail "--traceback"
[[ $(ldd "$dotyk" | grep -c 'liblua') == 1 ]] || fail "linked with other than one Lua library"
if ldd "$dotyk" | grep -q vtk; then fail "linked with VTK"; fi

# Ctrl-C ends a script.
"$dotyk" -e 'while true do end' 2>err.txt &
await_handler $!
kill -INT $!
wait $!
[[ $? == 1 && $(<err.txt) == 'dotyk: -e:1: interrupted' ]] || fail "interrupt: $(<err.txt)"

printf 'local x <const> = 7\nwhile true do end' >loop.lua
(echo x; sleep 2) | "$dotyk" -i loop.lua >out.txt 2>err.txt &
await_handler $! # a pipeline's last
kill -INT $!
wait $!
[[ $(<err.txt) == 'dotyk: loop.lua:2: interrupted' && $(<out.txt) == 7 ]] || fail "interrupt of -i: $(<err.txt)"

# What Lua's library does for ever, one Ctrl-C ends, too.
for code in 'table.move({}, 1, math.maxinteger - 1, 2)' 'table.insert(setmetatable({}, { __len = function() return 1 << 62 end }), 1, 0)' \
  'table.remove(setmetatable({}, { __len = function() return 1 << 62 end }), 1)' 'xpcall(error, function() while true do end end)' \
  'while true do xpcall(function() while true do end end, function() while true do end end) end' \
  '(("a"):rep(60)):find(("a?"):rep(60) .. ("a"):rep(60) .. "c")' '(("("):rep(1e6)):match "%b()"' '(("a"):rep(1e6)):gsub(".-b", "")' \
  '(("a"):rep(1e6)):gsub(".-.-b", print)' 'for _ in (("a"):rep(1e6)):gmatch "(.-)%1b" do end' \
  'coroutine.wrap(function() while true do pcall(string.find, ("a"):rep(1e6), ".-.-b") end end)()'; do
  "$dotyk" -e "$code" 2>err.txt &
  await_handler $!
  kill -INT $!
  wait $!
  [[ $? == 1 && $(<err.txt) == 'dotyk: -e:1: interrupted' ]] || fail "interrupt of $code: $(<err.txt)"
done
# A finalizer runs without hooks: at the end of the program one Ctrl-C ends it, else the second, whenever it comes.
rm out.txt
"$dotyk" -e 'print "kept" setmetatable({}, { __gc = function() while true do end end })' >out.txt &
for _ in {1..600}; do [[ -s out.txt ]] && break; sleep 0.1; done # by then it catches none
sleep 0.3
kill -INT $!
wait $!
[[ $? == 130 && $(<out.txt) == kept ]] || fail "interrupt at the end: $(<out.txt)"
"$dotyk" -e 'setmetatable({}, { __gc = function() while true do end end }) collectgarbage()' &
await_handler $!
kill -INT $!
sleep 1.2
kill -INT $!
wait $!
[[ $? == 130 ]] || fail "a second interrupt"

exit $((failures > 0))
