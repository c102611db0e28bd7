#!/bin/sh
# A recorded session at the prompt: what friction does to the pressure under a round punch. Completion, help, slips
# and what is said to them, a figure, a long solve interrupted and gone on from, %time, source, the last result _.
#
#   scripts/session/record.sh [DOTYK [FILE]]
#
# types the lines below into DOTYK (default: ./dotyk of the project) in a terminal of tmux and writes what the screen
# showed to FILE (default: session.txt beside this file). [Tab], [Ctrl-R …] and [Ctrl-C] stand where those keys were
# pressed; paths are those within the project. Lines that begin with -- are remarks, typed as well. A minute or two.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
dotyk=$(realpath "${1:-$here/../../dotyk}")
out=$(realpath "${2:-$here/session.txt}")
command -v tmux >/dev/null || { echo "record.sh needs tmux" >&2; exit 1; }

folder=$(mktemp -d)
tmux="tmux -L record$$ -f /dev/null"
trap '$tmux kill-server 2>/dev/null; rm -rf "$folder"' EXIT INT TERM
marks=$folder/marks
: >"$marks"
mkdir "$folder/work"

# An empty history and a folder of its own; pictures go to files alone.
$tmux start-server \; set-option -g history-limit 20000 \; new-session -d -s s -x 136 -y 48 \
  "cd '$folder/work' && HOME='$folder/work' XDG_STATE_HOME='$folder/work' DOTYK_PICTURES=none PAGER= TERM=screen '$dotyk'; sleep 1000"

# The line of the cursor.
line() { $tmux capture-pane -p -t s | sed -n "$(($($tmux display-message -p -t s '#{cursor_y}') + 1))p" | sed 's/ *$//'; }

# Waits until the prompt does.
ready() {
  tries=0
  while now=$(line); [ "$now" != ">" ] && [ "$now" != ">>" ]; do
    tries=$((tries + 1))
    [ $tries -lt 3000 ] || { echo "record.sh: no prompt after 5 minutes; the screen:" >&2; $tmux capture-pane -p -t s >&2; exit 1; }
    sleep 0.1
  done
}

text() { $tmux send-keys -t s -l -- "$1"; sleep 0.2; }
key() { $tmux send-keys -t s "$1"; sleep 0.5; }
enter() { key Enter; ready; }
say() { text "$1"; enter; }
# Where the cursor's line stands in the record, and how long it is; there $1 is shown.
mark() {
  row=$($tmux display-message -p -t s '#{e|+:#{history_size},#{e|+:#{cursor_y},1}}')
  printf '%s\t%s\t%s\n' "$row" "$(line | wc -m)" "$1" >>"$marks"
}
tab() { mark '[Tab]'; key Tab; }
clear_line() { key C-u; ready; }
# Searches the history; what was found is edited by the caller, or run.
recall() { key C-r; text "$1"; key C-e; mark "  [Ctrl-R $1]"; }

ready
say '-- How much does friction raise the pressure under a round punch?'
text 'dotyk.'; tab; text 'me'; tab; text '.'; tab; clear_line
say 'dotyk.mesh.rectangle?'
text 'm = dotyk.mesh.rectangle{ from = {-1,-1}, to = {1,0}, cells = {64,32}, element = '; tab; say 'Q1" }'
say 'm'
say 'steel = dotyk.material{ E = 210e3, nuu = 0.3 }'
say 'steel = dotyk.material{ E = 210e3, nu = 0.3 }  -- MPa'
text 'block = dotyk.body{ name = "block", mesh = '; tab; text ', material = '; tab; say ' }'
text 'dotyk.rigid.'; tab; clear_line
say 'punch = dotyk.rigid.gap{ normal = {0,1}, gap = function(x) return x^2/40 - 0.0005 end }'
say 'scene = dotyk.scene{ block }'
say 'contact = scene:contact{ block:part "tpo", rigid = punch }'
text 'contact = scene:contact{ block:part "t'; tab; text ', ri'; tab; say 'punch }'
say 's = dotyk.solve(scene)'
say 's'
say '-- no force: nothing holds the block yet'
text 'block:part("'; tab; text 'bo'; tab; say '):fix()'
recall 's = '; enter
say 's'
text 's:'; tab; clear_line
say 'c = s:contact(contact)'
say 'c'
say 's:displacement(block, 0.2, -0.1'
say ')'
say 'c.max_pressure'
say '-- that was without friction. Now with it, for any coefficient'
say 'function under(mu)'
say '  local scene = dotyk.scene{ block }'
say '  local friction = mu > 0 and dotyk.friction.coulomb(mu) or nil'
say '  local contact = scene:contact{ block:part "top", rigid = punch, friction = friction }'
say '  local s = dotyk.solve(scene)'
say '  return s, s:contact(contact)'
say 'end'
say 's, c = under(0.3)'
say 'c.max_pressure / _'
say 'for _, mu in ipairs{ 0, 0.1, 0.2, 0.4, 0.8 } do'
say '  local s, c = under(mu)'
say '  print(("friction %.1f: peak %5.0f, %2d nodes slip, %2d stick"):format(mu, c.max_pressure, c.slip, c.stick))'
say 'end'
say '-- five nodes in contact: is that fine enough?'
say 's:error_estimate()'
say '-- no. A finer mesh, and the lines from before'
say 'm = dotyk.mesh.rectangle{ from = {-1,-1}, to = {1,0}, cells = {256,128}, element = "Q1" }'
recall 'block ='; enter
recall ':fix'; enter
recall 'for _'; enter
say '-- 7 or 8 per cent more from 0.2 on, where most of it sticks. What does it look like?'
say 's, c = under(0.4)'
text 's:render{ '; tab; clear_line
say 's:render{ file = "punch.png", field = "von_mises", window = { -0.3, -0.3, 0.3, 0.1 } }'
say '-- and the pressures side by side'
say 'series = {}'
say 'for _, mu in ipairs{ 0, 0.1, 0.4 } do'
say '  local line = { name = "friction " .. mu, x = {}, y = {} }'
say '  for _, node in ipairs(select(2, under(mu)).nodes) do'
say '    if math.abs(node.x) < 0.12 then'
say '      table.insert(line.x, node.x)'
say '      table.insert(line.y, node.pressure)'
say '    end'
say '  end'
say '  table.insert(series, line)'
say 'end'
say 'dotyk.chart{ file = "pressure.png", x = "x", y = "pressure", series = serie }'
say 'dotyk.chart{ file = "pressure.png", x = "x", y = "pressure", series = series }'
say '-- do other methods agree, and how long do they take?'
say 'scene = dotyk.scene{ block }'
say 'friction = dotyk.friction.coulomb(0.4)'
say 'contact = scene:contact{ block:part "top", rigid = punch, friction = friction }'
text 'dotyk.solver.'; tab; clear_line
say '%time dotyk.solve(scene):contact(contact).max_pressure'
say '%time dotyk.solver.psor{}:solve(scene):contact(contact).max_pressure'
say '-- what if the steps are made smaller?'
text 'b = dotyk.solver.psor{ omega = 0.0001, max_iterations = 10000000 }:solve(scene)'; sleep 0.3
mark '  [Ctrl-C after some seconds]'; key Enter; sleep 8; key C-c; ready
say 'b.converged, b.iterations, b.reason'
say 'b:contact(contact).max_pressure'
say '-- near, but no. Newton goes on from there'
say 'b = dotyk.solve(scene, { start = b })'
say 'b.converged, b.iterations, b.method'
say 'b:contact(contact).max_pressure - c.max_pressure'
say '-- dotyk.adapt would have refined the mesh where it matters. How does it go about it?'
say 'source(dotyk.adapt)'
say '-- solve, estimate, refine: for another day'
text 'quit'; key Enter; sleep 1

# The screen from the beginning, with the marks put in.
$tmux capture-pane -p -S - -t s | sed "s/ *\$//; s|$root/||" >"$folder/screen"
{
  echo "-- $("$dotyk" --version), recorded by scripts/session/record.sh"
  echo
  awk -F '\t' '
    NR == FNR { count++; row[count] = $1; column[count] = $2 - 1; shown[count] = $3; next }
    {
      out = ""; from = 0
      while (at < count && row[at + 1] == FNR) {
        at++
        out = out substr($0, from + 1, column[at] - from) shown[at]
        from = column[at]
      }
      out = out substr($0, from + 1)
      if (out == "") empty++
      else { while (empty > 0) { print ""; empty-- } print out }
    }
  ' "$marks" "$folder/screen"
} >"$out"
