#!/bin/bash
# Every example of the reference, which are those of help(), runs as it stands, indented as help shows it: each in a
# folder of its own, empty. Arguments: the program, and words of the names of those to run (all).
. "$(dirname "$0")/scratch.sh"
chosen=${2-}

# One script and one line of its name for each callable; a callable without an example ends this.
cat >split.lua <<'EOF'
local page <const>, count = dotyk.reference(), 0
for entry in page:gmatch("### (`.-\n)%f[#\0]") do
  local name <const> = entry:match("^`([%w_.:]+)")
  local example <const> = assert(entry:match("```lua\n(.-\n)```\n"), "no example of " .. name)
  count = count + 1
  io.open(("%03d.lua"):format(count), "w"):write((("\n" .. example):gsub("\n", "\n    "))):close()
  print(("%03d %s"):format(count, name))
end
assert(count == select(2, page:gsub("### `", "")), "the page falls apart otherwise than here")

-- All that is callable in dotyk's tables is on the page.
local function check(path, value)
  if type(value) == "function" then assert(page:find("### `" .. path .. "%f[({]"), path .. " is not described") end
  if type(value) == "table" then for key, inner in pairs(value) do check(path .. "." .. key, inner) end end
end
check("dotyk", dotyk)
EOF
"$dotyk" split.lua >names || { cat names; exit 1; }

skipped=0 ran=0
while read -r number name; do
  [[ $name == *"$chosen"* ]] || continue
  mkdir "in$number" && cd "in$number" || exit 1
  start=$EPOCHREALTIME
  timeout 120 "$dotyk" "../$number.lua" >../output 2>&1 </dev/null
  status=$?
  cd ..
  seconds=$(((${EPOCHREALTIME/./} - ${start/./}) / 1000))
  ((seconds > 1000)) && echo "$name takes $seconds ms"
  if ((status != 0)) && grep -q "built without" output; then
    echo "skipped: $name: $(grep -m1 -o 'built without.*' output)"
    skipped=$((skipped + 1))
  elif ((status != 0)); then
    fail "$name, status $status:"
    sed 's/^/  | /' "$number.lua"
    tail -n 5 output
  else
    ran=$((ran + 1))
  fi
done <names
echo "$ran examples ran, $skipped skipped, $failures failed"
((failures == 0 && ran > 0)) && { [[ -n $chosen ]] || ((ran + skipped == $(wc -l <names))); }
