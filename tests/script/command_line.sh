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

"$dotyk" --traceback wrong.lua 2>&1 >/dev/null | grep -q 'stack traceback' || fail "--traceback"
[[ $(ldd "$dotyk" | grep -c 'liblua') == 1 ]] || fail "linked with other than one Lua library"
if ldd "$dotyk" | grep -q vtk; then fail "linked with VTK"; fi

# Ctrl-C ends a script.
"$dotyk" -e 'while true do end' 2>err.txt &
sleep 0.3
kill -INT $!
wait $!
[[ $? == 1 && $(<err.txt) == 'dotyk: -e:1: interrupted' ]] || fail "interrupt: $(<err.txt)"

exit $((failures > 0))
