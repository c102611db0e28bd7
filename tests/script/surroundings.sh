#!/bin/bash
# A full disk, a folder that is read only, no fonts, no home, no terminal, a program killed while it writes: each is
# answered in one line or does not matter, and a file once written stays whole. What needs mounts runs where a
# namespace of mounts can be had (as root), and says so where not.
typist=$(realpath "$2")
. "$(dirname "$0")/scratch.sh"

cat >solved.lua <<'LUA'
local function solved(load)
  local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {24,24} }, material = dotyk.material{ E = 1 } }
  b:part "left":fix()
  b:part "top":load{ 0, load }
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }
  return dotyk.solve(scene)
end
-- Each of the files that dotyk writes, in a folder: name → what writes it.
local writers <const> = {
  ["s.png"] = function(s, file) s:render{ file = file } end,
  ["c.png"] = function(_, file) dotyk.chart{ file = file, series = { { x = {0,1}, y = {0,1} } } } end,
  ["s.vtu"] = function(s, file) s:write(file) end,
  ["s.csv"] = function(s, file) s:write_contact(file) end }
return solved, writers
LUA
cat >refusals.lua <<'LUA'
-- refusals.lua FOLDER REASON: every file is refused for the reason, at the line, in one line; what was there stays.
local solved <const>, writers <const> = dofile(arg[0]:gsub("refusals", "solved"))
local s <const> = solved(-0.1)
for name, write in pairs(writers) do
  local file <const> = arg[1] .. "/" .. name
  local ok <const>, message <const> = pcall(function() write(s, file) end)
  if ok then error(name .. ": it was written") end
  if not message:find "^[^\n]*refusals.lua:%d+: [^\n]+$" and not message:find "^[^\n]*solved.lua:%d+: [^\n]+$" then error("not one line at the script's: " .. message) end
  if not message:find(arg[2], 1, true) then error(("no '%s' in: %s"):format(arg[2], message)) end
end
LUA

# Mounts of our own.
private() { unshare -m bash -c "$1" "$dotyk" "$folder"; }
if unshare -m true 2>/dev/null && private 'mkdir -p "$1/m" && mount -t tmpfs -o size=4k none "$1/m"' 2>/dev/null; then
  private 'mount -t tmpfs -o size=16k none "$1/m" && echo old >"$1/m/s.csv" && echo old >"$1/m/s.png" && head -c 8000 /dev/zero >"$1/m/filling"
    "$0" "$1/refusals.lua" "$1/m" "No space left on device" || exit 1
    [[ $(<"$1/m/s.csv") == old && $(<"$1/m/s.png") == old && $(ls -A "$1/m") == $(printf "filling\ns.csv\ns.png") ]] || { ls -lA "$1/m"; exit 1; }' || fail "a full disk"
  private 'mount -t tmpfs -o ro none "$1/m" && "$0" "$1/refusals.lua" "$1/m" "Read-only file system"' || fail "a folder that is read only"
  private 'mount -t tmpfs none /usr/share/fonts && mkdir "$1/fonts" && echo "<fontconfig/>" >"$1/fonts.conf" && cd "$1/fonts" &&
    FONTCONFIG_FILE=$1/fonts.conf "$0" -e "dotyk.chart{ file = [[c.png]], title = [[µ, ü]], x = [[x]], series = { { name = [[a]], x = {0,1}, y = {0,1} } } }" 2>err.txt
    [[ $? == 0 && $(head -c 4 c.png) == $(printf "\211PNG") && $(wc -c <c.png) -gt 3000 ]] || { cat err.txt; exit 1; }' || fail "no fonts"
  # A reader that was built and is not there any more is not one that was left out.
  readers=$(realpath "$(dirname "$dotyk")/../../readers")
  echo '<VTKFile/>' >lost.vtu
  private "mount -t tmpfs none '$readers'"' && "$0" -e "dotyk.mesh.load [[$1/lost.vtu]]" 2>"$1/err.txt"
    [[ $? == 1 && $(<"$1/err.txt") == "dotyk: -e:1: load: the program dotyk_vtu, which reads such files, is not beside dotyk or in its library folder"* ]] || { cat "$1/err.txt"; exit 1; }' || fail "a reader that is not there"
else
  echo "no namespace of mounts: full disks, read-only folders, absent fonts and lost readers are left out"
fi

# A limit of file sizes is a full disk of another kind: it ends other programs by a signal.
mkdir -p limited
(ulimit -f 1 && "$dotyk" -e 'local ok, message = pcall(function()
    local f = io.open("limited/x", "wb") f:setvbuf "no" assert(f:write(("x"):rep(5000))) end) assert(not ok and message:find "File too large", message)') || fail "a limit of file sizes, a script's own file"
echo old >limited/s.csv
(ulimit -f 1 && "$dotyk" -e 'local solved, writers = dofile "solved.lua" local s = solved(-0.1)
    local ok, message = pcall(function() writers["s.vtu"](s, "limited/s.vtu") end)
    assert(not ok and message:find "^-e:2: write: " or message:find "solved.lua", message) assert(not message:find "\n", message)
    assert(not io.open "limited/s.vtu")') || fail "a limit of file sizes"

# No home: history has nowhere to go. No terminal, or one that can do nothing.
terminals && typed=1 || typed=
for terminal in 'env -u TERM' 'env TERM=dumb' 'env TERM=nonsense'; do
  got=$(printf '6 * 7\n' | env -u HOME -u XDG_STATE_HOME $terminal "$dotyk" 2>&1)
  [[ $got == 42 ]] || fail "$terminal: $got"
  if [[ $typed ]]; then
    got=$(env -u HOME -u XDG_STATE_HOME $terminal "$typist" "$dotyk" '6 * 7\n')
    grep -qx '42' <<<"$got" || fail "$terminal, a prompt: $got"
  fi
done
got=$(printf '6 * 7\n' | HOME=/proc/nowhere "$dotyk" 2>&1)
[[ $got == 42 ]] || fail "a home that is not there: $got"

# Killed or ended while it writes, again and again: each file is one of the two, whole. Of one that is ended nothing else stays.
cat >writing.lua <<'LUA'
local solved <const>, writers <const> = dofile "solved.lua"
local states <const> = { solved(-0.1), solved(-0.3) }
local function write(k, folder) for name, one in pairs(writers) do if name ~= "c.png" then one(states[k], folder .. "/" .. name) end end end
if arg[1] then return write(tonumber(arg[1]), arg[2]) end
print "ready"
io.stdout:flush()
for i = 0, math.huge do write(i % 2 + 1, "now") end
LUA
mkdir one two now
"$dotyk" writing.lua 1 one && "$dotyk" writing.lua 2 two || fail "what is written"
cp one/* now
for signal in KILL KILL KILL KILL KILL KILL TERM TERM TERM TERM TERM HUP HUP HUP INT INT INT INT; do
  mkfifo ready
  "$dotyk" writing.lua >ready &
  writing=$!
  read -r _ <ready
  sleep "0.$((RANDOM % 5 + 1))$((RANDOM % 10))"
  kill -$signal $writing
  if [[ $signal == INT ]]; then kill -INT $writing 2>/dev/null; fi # the second Ctrl-C ends it, whatever it does
  wait $writing 2>/dev/null
  if [[ $signal == KILL ]]; then rm -f now/*.part-*; fi
  [[ $(ls -A now) == $'s.csv\ns.png\ns.vtu' ]] || fail "SIG$signal: $(ls -A now)"
  rm ready
  for file in s.png s.vtu s.csv; do
    cmp -s "now/$file" "one/$file" || cmp -s "now/$file" "two/$file" || fail "SIG$signal: $file is neither"
  done
done

exit $((failures > 0))
