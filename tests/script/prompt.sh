#!/bin/bash
# The prompt on a pseudo-terminal: editing, several lines, completion, questions,
# Ctrl-C, Ctrl-D, pasting, history. Words are keys for the typist.
tutorial=$(<"$(dirname "$0")/../../scripts/tutorial/01_a_body.lua")
typist=$(realpath "$2")
. "$(dirname "$0")/scratch.sh"
terminals || exit 77
export TERM=xterm
unset XDG_STATE_HOME
mkfifo "$folder/turns"
exec 9<>"$folder/turns"
printf '%8s' '' >&9

# expect NAME TEXT KEYS…: the text is on the screen. Sessions mostly wait, so eight run
# at the same time, each with a home folder of its own.
expect() {
  local name=$1 text=$2 screen
  shift 2
  export HOME=$folder/$name
  mkdir -p "$HOME"
  IFS= read -rn 1 -u 9
  screen=$("$typist" "$dotyk" "$@")
  printf ' ' >&9
  grep -qF -- "$text" <<<"$screen" && return
  fail "$name: no '$text' in"
  echo "$screen"
  echo >>"$folder/failed" # this shell is not the one that counts
}

expect "an expression" '42' '6 * 7\n' &
expect "several results" '3  "a"' '3, "a"\n' &
expect "several lines" '25' 'for i = 5, 5 do\n' 'print(i * i)\n' 'end\n' &
expect "an error" "prompt:1: unknown variable 'prnit', did you mean 'print'?" 'prnit(1)\n' &
expect "locals last" '41' 'local x = 40\n' 'x + 1\n' &
expect "timing" 's of processors' '%time 6 * 7\n' &
expect "timing of nothing" 'after % comes time' '%tine 6 * 7\n' &
expect "source" 'local refinement <const>' 'source(dotyk.adapt)\n' &
expect "completion of a field" '# dotyk: reference' 'print((dotyk.refe\t():sub(1, 18)))\n' &
expect "Ctrl-C on an endless loop" 'still here' 'while true do end\n' '\003' 'print("still" .. " here")\n' &
expect "Ctrl-C on an endless coroutine" 'still here' 'coroutine.wrap(function() while true do end end)()\n' '\003' 'print("still" .. " here")\n' &
expect "Ctrl-C on an endless pattern" 'still here' '(("a"):rep(60) .. "b"):find(("a?"):rep(60) .. ("a"):rep(60) .. "c")\n' '\003' 'print("still" .. " here")\n' &
# Lua runs finalizers without hooks, so that they cannot be stopped: the second Ctrl-C warns, the third ends the session
# (two more, should the third come too late); where the finalizer ends before, the session goes on.
final() { echo "setmetatable({}, { __gc = function() print(\"at\" .. \" work\") $1 end }) collectgarbage()\\n"; }
endless=$(final 'while true do end') sort=$(final 'table.sort(t)') fill='t = {} for i = 1, 1e7 do t[i] = i * 7919 % 6000011 end\n'
expect "Ctrl-C twice warns" 'press Ctrl-C again within 2 s to end dotyk and lose the session' "$endless" '\001at work' '\003' '\003' '\003' '\003' '\003' &
expect "Ctrl-C twice and the session" 'still here' "$fill" "$sort" '\001at work' '\003' '\003' 'print("still" .. " here")\n' 'os.exit()\n' &
(dotyk="trap : INT; $dotyk; echo status \$?" && expect "Ctrl-C three times" 'status 130' "$endless" '\001at work' '\003' '\003' '\003' '\003' '\003') &
expect "Ctrl-C clears the line" '12' 'error(' '\003' '3 * 4\n' &
block='block = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} }, material = dotyk.material{ E = 1, nu = 0.3 } }\n'
expect "completion of a part" 'bottom: 2 facets' "$block" 'block:part "bo\t:fix()\n' &
expect "all completions at the first Tab" 'bottom  left    right   top' "$block" 'block:part("\t' '\003' &
expect "completion of what a key may be" '"P1"  "P2"  "Q1"  "Q2"' 'dotyk.mesh.rectangle{ element = \t' '\003' &
expect "completion where a line begins" 'seconds = ' 'dotyk.solve(1, {\n' '\t' '\003' &
expect "completion where a line begins forgets the last one" 'seconds = ' 'dotyk.beam{ \t' '\003' 'dotyk.solve(1, {\n' '\t' '\003' &
mkdir "$folder/a file at home"
echo 'print("at " .. "home")' >"$folder/a file at home/tilde.lua"
expect "a file at home" 'at home' 'dofile("~/til\t")\n' &
expect "a question" 'Made by dotyk.body' "$block" 'block?\n' &
expect "Ctrl-D in an unfinished input" 'still here' 'if true then\n' '\004' 'print("still" .. " here")\n' &
expect "an unfinished input left is recalled" 'seven-7' 'print(("seven-" .. 7\n' '\003' '\033[A' '))\n' &
expect "an input of several lines is recalled as one" '8-8' 'for i = 7, 8 do\n' 'local x = i .. "-" .. i\n' 'if i == 8 then print(x) end end\n' 'print "else"\n' 'for\033[A\n' &
expect "pasted lines are inputs of their own" 'sum 42' '\033[200~local a = 40\nlocal b = a\n  + 2\nprint("sum " .. b)\033[201~\n' &
mkdir images
expect "a tutorial pasted" 'sinks 0.0897' "\\033[200~${tutorial//\\/\\\\}\\033[201~\n" '' 'print(("sinks %.4f"):format(-tip))\n' &
expect "completion of %time" 's of processors' '%ti\t6 * 7\n' &
(dotyk="stty rows 20; PAGER='sed s/^/paged:/' $dotyk" && expect "long help is paged" 'paged:  %time EXPRESSION' 'help()\n') &
(dotyk="stty rows 20; PAGER='head -n 1' $dotyk" && expect "a pager that goes early" '42' 'help()\n' '6 * 7\n') &
(dotyk="stty rows 20; PAGER=/nowhere $dotyk 2>/dev/null" && expect "a pager that is none" '  %time EXPRESSION' 'help()\n') &
(dotyk="stty rows 20; PAGER='sed s/%time/%zeit/' $dotyk --safe $folder" && expect "--safe starts no pager" '  %time EXPRESSION' 'help()\n') &
(unset TMUX STY DOTYK_PICTURES; export LC_TERMINAL=iTerm2 # as ssh passes on
  expect "a picture in iTerm2 by ssh" ']1337;File=inline=1' 'dotyk.chart{ file = "iterm.png", series = { { x = {0,1}, y = {0,1} } } }\n' '' '' '' '' '') &
mkdir -p "$folder/no history/.dotyk_history" # which root cannot write, either
expect "no history" 'dotyk: history is not kept: ' '6 * 7\n' &
cat >"$folder/shape.lua" <<'END'
local block = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = { -1, 0 }, to = { 1, 1 }, cells = { 8, 4 } }, material = dotyk.material{ E = 1000, nu = 0.3 } }
block:part "top":load{ 0, -1 }
block:part "left":fix "x"
local scene = dotyk.scene{ block }
scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }
shape = dotyk.shape{ scene = scene, moves = { { part = block:part "bottom", control_points = 4, lower = -0.005, upper = 0, start = { -0.003, -0.001, -0.002, -0.003 } } },
  objective = function(design)
    local q = 0
    for _ = 1, 15000 do
      for k, a in ipairs(design.alpha) do q = q + (a + 0.0007 * k)^2 end
    end
    return q
  end }
END
expect "Ctrl-C in an optimisation" 'ended: stopped, 4 variables' "dofile \"$folder/shape.lua\"\n" 'best = shape:optimise{ max_designs = 100000, tol_design = 1e-300, tol_gap = 0, on_design = function(k) if k == 2 then print("at " .. "work") end end }\n' \
  '\001at work' '\003' '' 'print(("ended: %s, %d variables"):format(best.reason, #best.alpha))\n' &
cat >"$folder/called.lua" <<'END'
function slowly(k) local t = os.clock() while os.clock() < t + 0.3 do end end
function run(scene) return dotyk.solver.psor{ on_iteration = slowly }:solve(scene) end
function make(mesh)
  local body = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 1, nu = 0.3 } }
  body:part "top":load{ 0, -1 }
  body:part "left":fix "x"
  local scene = dotyk.scene{ body }
  scene:contact{ body:part "bottom", rigid = dotyk.rigid.ball{ center = { 0.5, -5 }, radius = 5 } }
  return scene
end
unit = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 2, 2 } }
function refined() return dotyk.adapt{ mesh = unit, scene = make, tol = 1e-9, on_round = slowly } end
END
expect "Ctrl-C in a function of a file" 'so far 1' "dofile '$folder/called.lua'\n" 's = run(make(unit))\n' '\003' '' 'print("so far " .. s.iterations // s.iterations)\n' &
expect "Ctrl-C in an adaptive solve" 'ended: interrupted; this is the last whole round' "dofile '$folder/called.lua'\n" 's, h = refined()\n' '' '\003' '' 'print("ended: " .. h.reason, #h)\n' &
expect "Ctrl-C in a script that is run" 'called.lua:2: interrupted' "dofile '$folder/called.lua'\n" 'load "s = run(make(unit))" ()\n' '\003' '' &
expect "Ctrl-C in a solve that ends by itself" 'it had ended before it could be stopped: the result is whole' "$block" 'scene = dotyk.scene{ block } block:part "top":load{ 0, -1 } block:part "left":fix "x"\n' \
  'scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }\n' \
  's = dotyk.solver.pdas{ on_iteration = function() local t = os.clock() while os.clock() < t + 1.2 do end end }:solve(scene)\n' '\003' '' '' '' &
expect "Ctrl-C in a solve" 'stopped after iteration 1' "$block" 'scene = dotyk.scene{ block } block:part "top":load{ 0, -1 } block:part "left":fix "x"\n' \
  'scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }\n' \
  's = dotyk.solver.psor{ on_iteration = function() local t = os.clock() while os.clock() < t + 1.2 do end end }:solve(scene)\n' '\003' '' '' '' &
solves='b = 0 for i = 1, 9 do b = i s = slow:solve(scene) end\n'
expect "Ctrl-C in a loop of solves" 'loop 1: 11' "$block" 'scene = dotyk.scene{ block } block:part "top":load{ 0, -1 } block:part "left":fix "x"\n' \
  'scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }\n' \
  'function slowly() local t = os.clock() while os.clock() < t + 1.2 do end end slow = dotyk.solver.pdas{ on_iteration = slowly }\n' \
  "$solves" '\003' '' '' '' '' 'print(("loop %d: %d"):format(b - 1, s.unknowns - 4))\n' &
(
  mkdir "$folder/history" # its owner alone reads it, also one that others could
  umask 022
  expect "history" 'ninety-9' 'print("ninety" .. "-" .. 9)\n'
  [[ $(stat -c %a "$HOME/.dotyk_history") == 600 ]] || echo "the history's mode" >>"$folder/failed"
  chmod 644 "$HOME/.dotyk_history"
  expect "history" 'ninety-9' 'print("nin\033[A\n'
  expect "history" '3-3' 'for i = 3, 3 do\n' 'print(i .. "-" .. i) end\n'
  expect "history" '3-3' '\022i = 3\r'
  [[ $(stat -c %a "$HOME/.dotyk_history") == 600 ]] || echo "the history's mode, of an old one" >>"$folder/failed"
  dotyk="$dotyk --safe $folder" expect "history" 'ninety-9' 'print("nin\033[A\n'
  dotyk="$dotyk --safe $folder" expect "history" 'safe-7' 'print("safe" .. "-" .. 7)\n'
  expect "history" 'safe-7' 'print("saf\033[A\n'
) &
wait

# A picture is shown where the terminal can: by kitty's protocol the file's very bytes.
picture=$folder/picture.png
printf 'dotyk.chart{ file = "%s", series = { { x = { 0, 1 }, y = { 0, 1 } } } }\n' "$picture" |
  DOTYK_PICTURES=kitty timeout 120 "$dotyk" | tr -d '\033\n' | sed 's/_G[^;]*;//g; s/\\//g; s/".*//' | base64 -d >"$folder/shown" 2>/dev/null
cmp "$folder/shown" "$picture" || fail "a picture in the terminal"
told=$(printf 'dotyk.chart{ file = "%s", series = { { x = { 0, 1 }, y = { 0, 1 } } } }\n' "$picture" "$picture" | DOTYK_PICTURES=kity timeout 120 "$dotyk" 2>&1 >/dev/null)
[[ $told == "dotyk: DOTYK_PICTURES is 'kity', which is left out; it can be kitty, iterm, sixel, none" ]] || fail "a protocol that is none: $told"
mkdir "$folder/few"
ln -s "$(command -v sh)" "$folder/few/sh"
told=$(printf 'dotyk.chart{ file = "%s", series = { { x = { 0, 1 }, y = { 0, 1 } } } }\n' "$picture" "$picture" | PATH=$folder/few DOTYK_PICTURES=sixel "$dotyk" 2>&1 >/dev/null)
[[ $told == "dotyk: img2sixel is missing"* && $(wc -l <<<"$told") == 1 ]] || fail "sixel without img2sixel: $told"
[[ $failures == 0 && ! -e $folder/failed ]]
