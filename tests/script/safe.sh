#!/bin/bash
# dotyk --safe: what a stranger's script tries, and is refused; what an honest one does, unchanged. And the
# limits of instructions, of processors' time and of memory.
. "$(dirname "$0")/scratch.sh"
scripts=$2
export ASAN_OPTIONS=detect_leaks=0  # behind the kernel's rule for the folder the leak sanitizer can neither read its list nor stop threads
mkdir below below/images outside
echo 'a secret' >outside/secret.txt
echo 'return "honest"' >below/module.lua
echo 'return "stranger"' >outside/module2.lua
ln -s ../outside below/link
ln -s ../outside/secret.txt below/file_link
ln -s ../outside/new.txt below/dangling
ln -s /etc below/etc

# refused NAME TEXT CODE: the script ends with the line "-e:1: …TEXT…" and nothing else; nothing outside has changed.
refused() {
  local got status
  got=$(timeout 60 "$dotyk" --safe below -e "$3" 2>&1)
  status=$?
  [[ $status == 1 && $got == "dotyk: -e:1: "*"$2"* && $(grep -vc "^$(printf "\t")" <<<"$got") == 1 ]] || fail "$1: status $status, $got"
  [[ $(ls outside) == $'module2.lua\nsecret.txt' && $(<outside/secret.txt) == 'a secret' ]] || fail "$1: something outside has changed"
  [[ $got != *'a secret'* ]] || fail "$1: the secret is out"
}
# allowed NAME OUTPUT CODE
allowed() {
  local got
  got=$(timeout 60 "$dotyk" --safe below -e "$3" 2>&1)
  [[ $got == "$2" ]] || fail "$1: got $got"
}

no="not for scripts run with --safe"
out="is not below 'below', the folder of this run (--safe)"
refused "a program" "os.execute: $no" 'os.execute "touch outside/x"'
refused "a pipe" "io.popen: $no" 'io.popen "touch outside/x"'
refused "a temporary name" "os.tmpname: $no" 'os.tmpname()'
refused "a temporary file" "io.tmpfile: $no" 'io.tmpfile()'
refused "machine code" "package.loadlib: $no" 'package.loadlib("/lib/x86_64-linux-gnu/libc.so.6", "system")'
refused "machine code by require" "module 'libc' not found" 'package.cpath = "/lib/x86_64-linux-gnu/?.so.6" require "libc"'
refused "a search for files" "package.searchpath: $no" 'package.searchpath("passwd", "/etc/?")'
refused "reading by .." "open: 'below/../outside/secret.txt' $out" 'io.write(io.open("below/../outside/secret.txt"):read "a")'
refused "reading by an absolute path" "open: '/etc/passwd' $out" 'io.open "/etc/passwd"'
refused "reading lines" "lines: 'outside/secret.txt' $out" 'for l in io.lines "outside/secret.txt" do print(l) end'
refused "io.input" "input: 'outside/secret.txt' $out" 'io.input "outside/secret.txt" print(io.read())'
refused "io.output" "output: 'outside/x' $out" 'io.output "outside/x"'
refused "a link to a folder" "open: 'below/link/secret.txt' $out" 'io.open "below/link/secret.txt"'
refused "a link to a file" "open: 'below/file_link' $out" 'io.open "below/file_link"'
refused "a link to nothing yet" "open: 'below/dangling' $out" 'io.open("below/dangling", "w")'
refused "a link to the system" "open: 'below/etc/passwd' $out" 'io.open "below/etc/passwd"'
refused "a process's own root" "open: '/proc/self/root/etc/passwd' $out" 'io.open "/proc/self/root/etc/passwd"'
refused "the folder itself" "remove: 'below' $out" 'os.remove "below"'
refused "a folder that begins alike" "open: 'below2/x' $out" 'io.open("below2/x", "w")'
refused "renaming out" "rename: 'outside/x' $out" 'os.rename("below/module.lua", "outside/x")'
refused "renaming in" "rename: 'outside/secret.txt' $out" 'os.rename("outside/secret.txt", "below/x")'
refused "removing" "remove: 'outside/secret.txt' $out" 'os.remove "outside/secret.txt"'
refused "dofile" "dofile: 'outside/module2.lua' $out" 'dofile "outside/module2.lua"'
refused "loadfile" "loadfile: 'outside/module2.lua' $out" 'loadfile "outside/module2.lua"'
refused "include" "loadfile: 'outside/module2.lua' $out" 'include "outside/module2.lua"'
refused "require of a file outside" "module 'module2' not found" 'package.path = "outside/?.lua;/?" require "module2"'
refused "searchers kept from before" "attempt to call a nil value" 'package.searchers[3] "x"'
refused "a compiled chunk" "attempt to load a binary chunk (mode is 't')" 'error(select(2, load(string.dump(function() end), "x", "b")), 0 + 1)'
refused "a compiled chunk from a file" "attempt to load a binary chunk" 'local f = io.open("below/b", "wb") f:write(string.dump(function() end)) f:close() error(select(2, loadfile("below/b", "b")), 1)'
refused "the registry" "debug.getregistry: $no" 'debug.getregistry()'
refused "upvalues" "debug.getupvalue: $no" 'debug.getupvalue(dotyk.adapt, 2)'
refused "upvalues of io.open" "debug.getupvalue: $no" 'print(debug.getupvalue(io.open, 1))'
refused "a hook" "debug.sethook: $no" 'coroutine.wrap(function() debug.sethook() end)()'
refused "metatables by debug" "debug.setmetatable: $no" 'debug.setmetatable("", {})'
refused "debug by require" "debug.getmetatable: $no" 'require "debug".getmetatable(io.stdout)'
refused "debug by package.loaded" "debug.getinfo: $no" 'package.loaded.debug.getinfo(1)'
refused "metatables of files" "attempt to index a nil value" 'getmetatable(io.stdout).__gc.x = 1'
refused "metatables of dotyk's objects" "attempt to" 'getmetatable(dotyk.material{ E = 1 }).__gc = print'
refused "metatables of strings" "attempt to index a nil value" 'getmetatable("").__index = function() end; ("x").rep.y = 1'
refused "a figure" "chart: '/tmp/x.png' $out" 'dotyk.chart{ file = "/tmp/x.png", series = { { x = {0,1}, y = {0,1} } } }'
refused "a figure by a link" "chart: 'below/link/x.png' $out" 'dotyk.chart{ file = "below/link/x.png", series = { { x = {0,1}, y = {0,1} } } }'
refused "a name with a zero byte" "chart: 'file' must be the name of a file, it has a zero byte" 'dotyk.chart{ file = "outside/x.png\0below/x.png", series = { { x = {0,1}, y = {0,1} } } }'
refused "a mesh" "load: 'outside/x.msh' $out" 'dotyk.mesh.load "outside/x.msh"'
refused "a geometry" "gmsh: $no" 'dotyk.mesh.gmsh{ text = "" }'
refused "a program's file" "qp: 'outside/x.qps' $out" 'dotyk.qp "outside/x.qps"'
refused "an LCP's file" "lcp: 'outside/x' $out" 'dotyk.lcp{ file = "outside/x" }'
refused "the table of work_precision" "is not below" 'dotyk.work_precision{ file = "below/x.png", csv = "outside/x.csv", scene = function() end }'
refused "source of another file" "open: 'outside/secret.txt' $out" 'source(load("return 1", "@outside/secret.txt"))'
solved='local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} }, material = dotyk.material{ E = 1 } }
  b:part "bottom":fix() b:part "top":load{ 0, -1 } local s = dotyk.solve(dotyk.scene{ b })'
solved=${solved//$'\n'/ }
refused "a solution's file" "write: 'outside/s.vtu' $out" "$solved s:write 'outside/s.vtu'"
refused "a table of contact" "write_contact: 'outside/s.csv' $out" "$solved s:write_contact 'outside/s.csv'"
refused "a picture" "render: 'below/../s.png' $out" "$solved s:render{ file = 'below/../s.png' }"
refused "the argument by position within a pattern" "is not below" "local x = dotyk.shape; $solved s:render{ file = ('below/%03d/../../x.png'):format(1) }"

# A mesh is read, and nothing that lies beside it, though Gmsh takes x.msh.opt for commands.
cat >below/x.msh <<'MSH'
$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
3
1 0 0 0
2 1 0 0
3 0 1 0
$EndNodes
$Elements
1
1 2 2 1 1 1 2 3
$EndElements
MSH
echo 'SystemCall "touch outside/ran"; Printf("x") > "outside/written";' >below/x.msh.opt
got=$("$dotyk" --safe below -e 'print(dotyk.mesh.load "below/x.msh".cell_count)' 2>&1)
[[ $got == 1 ]] || fail "a mesh below: $got"
[[ $(ls outside) == $'module2.lua\nsecret.txt' ]] || fail "a mesh below: something outside has changed"
rm below/x.msh*

allowed "the environment" 'nil' 'print(os.getenv "HOME")'
got=$("$dotyk" --safe below -e 'package.path = "outside/?.lua;below/?.lua" local f = io.open("below/new.txt", "w") f:write "text" f:close()
  print(require "module", dofile "below/module.lua", loadfile "below/module.lua"(), load "return 7"(), io.open("below/images/../new.txt"):read "a", os.remove "below/new.txt", #debug.traceback() > 0)' 2>&1)
[[ $got == $'honest\thonest\thonest\t7\ttext\ttrue\ttrue' ]] || fail "files below: $got"
allowed "figures below" 'below/images/x.png' 'print(dotyk.chart{ file = "below/images/x.png", series = { { x = {0,1}, y = {0,1} } } })'
allowed "source of dotyk's own" 'true' 'local p, t = print, "" print = function(x) t = t .. x end source(dotyk.adapt) p(#t > 100)'
allowed "errors of files as ever" $'nil\tbelow/none: No such file or directory\t2' 'print(io.open "below/none")'
allowed "an honest script" "$("$dotyk" -e 'for i = 1, 3 do print(pcall(error, i), coroutine.wrap(function() coroutine.yield(i) end)()) end')" \
  'for i = 1, 3 do print(pcall(error, i), coroutine.wrap(function() coroutine.yield(i) end)()) end'

# The first script writes what it writes without --safe.
mkdir plain plain/images
(cd plain && "$dotyk" "$scripts/first.lua" >../plain.txt 2>&1) || fail "first.lua: $(<plain.txt)"
(cd below && "$dotyk" --safe . "$scripts/first.lua" >../safe.txt 2>&1) || fail "first.lua under --safe: $(<safe.txt)"
[[ $(ls plain/images) == "$(ls below/images | grep -vx x.png)" && -n $(ls plain/images) ]] || fail "first.lua: other figures"
for picture in plain/images/*; do cmp "$picture" "below/images/${picture##*/}" || fail "another $picture"; done

# Instructions: nothing swallows the limit. Each script would run for ever.
spent() {
  local got
  got=$(timeout 60 "$dotyk" --instructions 3e6 -e "$2" 2>&1)
  [[ $? == 1 && $got == *'the limit of 3000000 instructions is reached (--instructions)' ]] || fail "$1: $got"
}
spent "a loop" 'while true do end'
spent "a loop of pcalls" 'while true do pcall(function() while true do end end) end'
spent "a message handler" 'xpcall(function() while true do end end, function() while true do end end)'
spent "coroutines" 'while true do coroutine.wrap(function() for i = 1, 1e4 do end end)() end'
spent "many short coroutines" 'local function f() for i = 1, 100 do end end while true do local c = coroutine.create(f) coroutine.resume(c) end'
spent "coroutines within coroutines" 'local function f() pcall(function() while true do end end) coroutine.wrap(f)() end while true do pcall(f) end'
spent "to-be-closed variables" 'local function again() local x <close> = setmetatable({}, { __close = function() while true do end end }) error "x" end while true do pcall(again) end'
spent "a coroutine that is closed" 'local co = coroutine.create(function() local x <close> = setmetatable({}, { __close = function() while true do end end }) coroutine.yield() end) coroutine.resume(co) while true do pcall(coroutine.close, co) end'
spent "a hook taken away" 'pcall(function() debug.sethook() end) while true do end'
spent "setmetatable as Lua has it" 'pcall(function() select(2, debug.getupvalue(setmetatable, 1))({}, { __gc = function() while true do end end }) end) collectgarbage() while true do end'
spent "the end of a file" 'pcall(function() getmetatable(io.stdout).__gc = function() while true do end end end) while true do end'
spent "a comparison" 'table.sort({ 3, 1, 2 }, function() while true do end end)'
spent "a field of a scene" 'while true do pcall(dotyk.mesh.rectangle, { from = {0,0}, to = {1,1}, cells = {1,1}, map = function() while true do end end }) end'
got=$("$dotyk" --instructions 1e6 -e 'setmetatable({}, { __gc = function() while true do end end })' 2>&1)
[[ $got == 'dotyk: -e:1: setmetatable: no __gc where instructions are counted (--instructions)' ]] || fail "finalizers: $got"
got=$("$dotyk" --instructions 1e6 -e 'debug.sethook()' 2>&1)
[[ $got == 'dotyk: -e:1: debug.sethook: not for scripts run with --instructions' ]] || fail "a hook: $got"
got=$("$dotyk" --instructions 1e6 -e 'local n = 0 for i = 1, 1e4 do n = n + i end print(n)' 2>&1)
[[ $got == 50005000 ]] || fail "within the limit: $got"
"$dotyk" --instructions 1e12 -e 'while true do pcall(function() while true do end end) end' 2>err.txt &
await_handler $!
kill -INT $!
wait $!
[[ $(<err.txt) == 'dotyk: -e:1: interrupted' ]] || fail "Ctrl-C beside the limit: $(<err.txt)"

# Processors' time: also of what runs in C for ever.
got=$(timeout 60 "$dotyk" --seconds 1 -e 'table.move({}, 1, 1 << 60, 2)' 2>&1)
[[ $? == 1 && $got == "dotyk: the limit of processors' time is reached (--seconds)" ]] || fail "--seconds: $got"

# That of the programs that read files counts, and each gets no more than what is left: a bad file of many cells, again and again.
bad='local f = io.open("below/bad.vtu", "w")
  local function array(name, count, value)
    f:write([[<DataArray type="]], name == "x" and "Float64" or "Int64", [[" Name="]], name, [[" NumberOfComponents="]], name == "x" and 3 or 1, [[" format="ascii">]], "\n")
    for i = 0, count - 1 do f:write(value(i), "\n") end
    f:write "</DataArray>"
  end
  f:write [[<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid><Piece NumberOfPoints="160801" NumberOfCells="160000"><Points>]]
  array("x", 160801, function(i) return ("%d %d 0"):format(i % 401, i // 401) end)
  f:write "</Points><Cells>"
  array("connectivity", 160000, function(i) local a = i // 400 * 401 + i % 400 return ("%d %d %d %d"):format(a, a + 401, a + 402, a + 900000) end)
  array("offsets", 160000, function(i) return 4 * i + 4 end)
  array("types", 160000, function() return 9 end)
  f:write "</Cells></Piece></UnstructuredGrid></VTKFile>" f:close()'
"$dotyk" -e "$bad"
got=$(timeout 60 "$dotyk" --safe below --seconds 1 -e 'while true do pcall(dotyk.mesh.load, "below/bad.vtu") end' 2>&1)
[[ $? == 1 && $got == "dotyk: the limit of processors' time is reached (--seconds)" ]] || fail "--seconds and files: $got"
rm below/bad.vtu

# Files all together, whatever writes them; what is removed counts, and each takes a block of the disk.
many() {
  local got
  got=$(timeout 60 "$dotyk" --safe below --files 200K -e "$2" 2>&1)
  [[ $? == 1 && $got == "dotyk: -e:1: $3: the limit of the bytes of all files together is reached (--files)" ]] || fail "files: $1: $got"
  [[ $(du -sb below | cut -f 1) -lt 2000000 ]] || fail "files: $1: $(ls -l below)"
}
many "one that grows" 'local f = io.open("below/many", "w") while true do f:write(("x"):rep(1000), 1, 2.5) end' write
many "io.write" 'io.output "below/many" while true do io.write(("x"):rep(1000)) end' write
many "written and removed" 'while true do local f <close> = io.open("below/many", "w") f:write(("x"):rep(90000)) os.remove "below/many" end' write
many "empty ones" 'for i = 1, 1e4 do io.open("below/many" .. i % 9, "a"):close() end' open
many "figures" 'for i = 1, 1e3 do dotyk.chart{ file = "below/many.png", series = { { x = {0,1}, y = {0,1} } } } end' chart
many "solutions in pieces" "$solved for i = 1, 1e3 do s:write 'below/many.pvtu' end" write
got=$("$dotyk" --safe below --files 200K -e 'local n = 0 for i = 1, 500 do io.write(("x"):rep(1000)) n = n + 1 end io.stderr:write(n)' 2>&1 >/dev/null)
[[ $got == 500 ]] || fail "files: standard output counts: $got"
[[ $(ls below) != *part-* ]] || fail "files: $(ls below)"
rm -f below/many*

# The clock: also of what waits.
got=$(sleep 60 | timeout 30 "$dotyk" --safe below --clock 1 -e 'io.read()' 2>&1)
[[ $? == 1 && $got == 'dotyk: the limit of time is reached (--clock)' ]] || fail "--clock: $got"

# Nothing that a terminal would obey is printed, by whomever; letters are.
harmless() {
  local got
  got=$("$dotyk" --safe below -e "$2" 2>&1)
  [[ $got == "$3" ]] || fail "printed by $1: $(od -c <<<"$got" | head -5)"
}
harmless print 'print("\27[31mé – \u{1F600}\tx\r", "\u{9b}1m\x9b\xc3")' '\x1b[31mé – 😀	x\x0d	\xc2\x9b1m\x9b\xc3'
harmless io.write 'io.write("\xc2") io.write("\x9b1m\0\127") io.write("\xc3") io.stdout:write("\xa9\n")' '\xc2\x9b1m\x00\x7fé'
harmless io.stderr 'io.stderr:write "\27]0;title\7\n"' '\x1b]0;title\x07'
harmless "an error" 'error("\27[2J", 0)' 'dotyk: \x1b[2J'
harmless warn 'warn "@on" warn "\27c"' 'Lua warning: \x1bc'
harmless "a message of dotyk" 'dotyk.material{ ["\27c"] = 1 }' "dotyk: -e:1: material: unknown key '\x1bc', expected 'E', 'nu', 'plane', 'stiffness' or 'density'"

# The same without a word where the script is a stranger's; what Lua's library does meanwhile no count of instructions sees.
endless() {
  local got
  got=$(timeout 60 "$dotyk" --safe below --seconds 1 -e "$2" 2>&1)
  [[ $? == 1 && ($got == "dotyk: the limit of processors' time is reached (--seconds)" || $got == *'not enough memory') ]] || fail "$1: $got"
}
endless "a pattern" '(("a"):rep(40) .. "b"):find(("a?"):rep(40) .. ("a"):rep(40) .. "c")'
endless "a pattern of balances" 'for i = 1, 1e6 do (("("):rep(3e5)):find "%b()" end'
endless "a substitution" '(("a"):rep(3e5)):gsub(".-b", "")'
endless "a long string" 'local s = {} for i = 1, 1e6 do s[i] = ("x"):rep(1 << 30) end'
"$dotyk" --safe below -e 'while true do end' 2>err.txt &
await_handler $!
limits=$(</proc/$!/limits)
status=$(</proc/$!/status)
kill -9 $!
wait $! 2>/dev/null
[[ $limits =~ 'Max cpu time'\ +600\ +605\  && $limits =~ 'Max file size'\ +1000000000\ +1000000000\  && $limits =~ 'Max core file size'\ +0\ +0\  ]] || fail "limits of --safe: $limits"
[[ $status == *$'NoNewPrivs:\t1'* || $(<err.txt) == *'no Landlock'* ]] || fail "Landlock: $status"
[[ $limits =~ 'Max address space'\ +([0-9]+)\ +([0-9]+)\  && ${BASH_REMATCH[1]} == "${BASH_REMATCH[2]}" ]] || "$dotyk" --memory 2G -e '' 2>&1 | grep -q . || fail "memory of --safe: $limits"

# Memory.
if [[ $("$dotyk" --memory 2G -e 'print(1)' 2>&1) == 1 ]]; then # a sanitized program takes more for itself
  got=$("$dotyk" --memory 600M -e 'local t = {} while true do t[#t + 1] = ("x"):rep(1e6 + #t) end' 2>&1)
  [[ $got == *'not enough memory' ]] || fail "--memory: $got"
  got=$("$dotyk" --memory 2G -e 'dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {10000,10000} }' 2>&1)
  [[ $got == 'dotyk: -e:1: rectangle: a mesh of 1e+08 cells needs'* ]] || fail "--memory and a mesh: $got"
fi

# Wrong use.
[[ $("$dotyk" --safe 2>&1) == 'dotyk: --safe needs a folder (dotyk --help tells more)' ]] || fail "--safe alone"
[[ $("$dotyk" --safe '' -e '' 2>&1) == "dotyk: '' is not a folder" ]] || fail "--safe without a name"
[[ $("$dotyk" --safe nowhere -e '' 2>&1) == "dotyk: 'nowhere' is not a folder" ]] || fail "--safe nowhere"
[[ $("$dotyk" --memory 5X -e '' 2>&1) == "dotyk: --memory needs a number of at least 1, as 500M or 2G, got '5X' (dotyk --help tells more)" ]] || fail "--memory 5X"
[[ $("$dotyk" --instructions many -e '' 2>&1) == "dotyk: --instructions needs a number of at least 1, got 'many' (dotyk --help tells more)" ]] || fail "--instructions many"

exit $((failures > 0))
