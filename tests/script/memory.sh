#!/bin/bash
# What does not fit into memory is refused before it is made, and nothing is lost by it.
. "$(dirname "$0")/scratch.sh"
ulimit -v 2000000  # KB
# A sanitized program takes more address space than that for itself.
[[ $("$dotyk" -e 'print(1)' 2>&1) == 1 ]] || exit 77

# expect NAME TEXT CODE: the program prints TEXT's line and no other.
expect() {
  local got
  got=$("$dotyk" -e "$3" 2>&1)
  [[ $got =~ ^$2$ ]] && return
  fail "$1, got: $got"
}

expect "a mesh" "dotyk: -e:1: rectangle: a mesh of 1e\+08 cells needs 4 GB of memory, [0-9.]+ GB are available.*" \
  'dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {10000,10000} }'
expect "a factor, then a smaller one" "false -e:8: solve: the factor of [0-9]+ unknowns needs 2.[0-9]+ GB of memory, .* true" \
  'local function cube(n)
     local b = dotyk.body{ mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {n,n,n} }, material = dotyk.material{ E = 1 } }
     b:part "bottom":fix()
     b:part "top":load{ 0, 0, -1 }
     return dotyk.scene{ b }
   end
   local large, small = cube(40), cube(4)
   local ok, message = pcall(function() dotyk.solver.pdas{}:solve(large) end)
   io.write(tostring(ok), " ", message, " ", tostring(dotyk.solve(small).converged))'
expect "a script's own tables" "false not enough memory true" \
  'local ok, message = pcall(function() local t = {} while true do t[#t + 1] = ("x"):rep(1e6 + #t) end end)
   io.write(tostring(ok), " ", message, " ", tostring(dotyk.material{ E = 1 }.E == 1))'

# OpenBLAS asks for ever for a buffer that it does not get, in each of its threads: less and less space must end in an
# answer, or a line that says what is missing.
unset OPENBLAS_NUM_THREADS
solve='local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} }, material = dotyk.material{ E = 1 } }
  b:part "bottom":fix()
  b:part "top":load{ 0, -1 }
  print(dotyk.solve(dotyk.scene{ b }).converged)'
line='^(true|dotyk: (-e:[0-9]: solve: [^:]* needs [0-9.]+ GB of memory, .*|--memory [0-9]+M is less than dotyk needs to start \(about [0-9]+M\)|(-e:[0-9]: )?.*(not enough|out of) memory))$'
for megabytes in 300 250 220 200 190 180 160 140 130 120 110 100 90 50; do
  got=$(timeout -s KILL 120 "$dotyk" --memory ${megabytes}M -e "$solve" 2>&1)
  [[ $? != 137 && $got =~ $line ]] || fail "--memory ${megabytes}M: $got"
  ((megabytes < 130)) && continue # the system itself may not get the program loaded
  got=$(ulimit -v $((megabytes * 1000)); timeout -s KILL 120 "$dotyk" -e "$solve" 2>&1)
  [[ $? != 137 && $got =~ $line ]] || fail "ulimit -v, $megabytes MB: $got"
done
# Subdomains are shared out to threads, each of which wants a buffer.
cut="${solve/dotyk.solve(/dotyk.solver.feti{ subdomains = 4 \}:solve(}"
for megabytes in 500 420 400 380 360 340 320 300 280; do
  got=$(timeout -s KILL 120 "$dotyk" --memory ${megabytes}M -e "$cut" 2>&1)
  [[ $? != 137 && $got =~ $line ]] || fail "subdomains with --memory ${megabytes}M: $got"
done
# Mesa and VTK crash where their buffers do not fit.
line="^(dotyk: -e:1: [a-z]+: (the drawing library|a picture .*) needs [0-9]+ MB of memory, and the limit \(--memory, ulimit -v\) leaves [0-9]+ MB)?$"
bent='dotyk.solve(dotyk.beam{ length = 1, EJ = 1, load = -1, left = { deflection = dotyk.law.signorini() }, right = { deflection = dotyk.law.signorini() } }):'
for megabytes in 350 365 420 500 540 560 580 620 650 700 800 1000 1200 1400 1600; do
  for code in 'dotyk.chart{ file = "x.png", series = { { x = {0,1}, y = {0,1} } } }' "${bent}render{ file = 'x.png' }"; do
    got=$("$dotyk" --memory ${megabytes}M -e "$code" 2>&1)
    (($? <= 1)) && [[ $got =~ $line ]] || fail "a figure with --memory ${megabytes}M: $got"
  done
done
[[ -s x.png ]] || fail "no figure with --memory 1600M"
[[ $("$dotyk" --memory 180M -e 'print(1)' 2>&1) == 1 ]] || fail "--memory 180M"
[[ $("$dotyk" --memory 20M -e 'print(1)' 2>&1) =~ ^'dotyk: --memory 20M is less than dotyk needs to start (about '[0-9]+'M)'$ ]] || fail "--memory 20M"

exit $((failures > 0))
