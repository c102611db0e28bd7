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
   local ok, message = pcall(function() dotyk.solve(large) end)
   io.write(tostring(ok), " ", message, " ", tostring(dotyk.solve(small).converged))'
expect "a script's own tables" "false not enough memory true" \
  'local ok, message = pcall(function() local t = {} while true do t[#t + 1] = ("x"):rep(1e6 + #t) end end)
   io.write(tostring(ok), " ", message, " ", tostring(dotyk.material{ E = 1 }.E == 1))'

# OpenBLAS asks for ever for a buffer that it does not get: less and less space must end in an answer, or no start.
for megabytes in 250 220 190 160 140; do
  got=$( (ulimit -v $((megabytes * 1000)); OPENBLAS_NUM_THREADS=1 timeout 20 "$dotyk" -e \
    'local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} }, material = dotyk.material{ E = 1 } }
     b:part "bottom":fix()
     b:part "top":load{ 0, -1 }
     print(dotyk.solve(dotyk.scene{ b }).converged)' 2>&1) )
  [[ $? != 124 ]] && continue
  fail "$megabytes MB: hangs, got: $got"
done

exit $((failures > 0))
