-- Ten million unknowns on two ranks: how seconds, memory, steps and iterations of multigrid grow with the size.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/growth.lua [N…] [ranks=2] [runs=3]
--
-- S3, a rigid paraboloid on a cube of N³ cells, frictionless and with Coulomb's coefficient 0.3. The ranks refine a cube of at least 8³ cells where it lies.
-- Seconds are those of the whole solution, from the coarse cells to the answer: of the second one in each process (scale.lua), since a virtual machine needs
-- seconds for the memory that the first one takes from it. Medians of so many processes. Memory is the sum of the peaks of all ranks.
-- The exponent is the slope of the line through the logarithms of seconds against unknowns.

local line <const>, median <const> = include "../lib/least_squares.lua".line, include "../lib/punch_scenes.lua".median
local own_process <const> = include "../lib/own_process.lua"
local study <const> = (arg[0]:match "(.*/)" or "./") .. "scale.lua"

local sizes <const>, given <const> = {}, { ranks = 2, runs = 3 }
for _, word in ipairs(arg) do
  local name <const>, value <const> = word:match "^(%a+)=([1-9]%d*)$"
  if given[name] then given[name] = tonumber(value)
  else sizes[#sizes + 1] = math.tointeger(word) or error(("growth: %s is neither a number of cells nor ranks= or runs="):format(word), 0) end
end
if #sizes == 0 then table.move({ 32, 64, 96, 128, 152 }, 1, 5, 1, sizes) end

print(("S3 on %d ranks, medians of %d runs"):format(given.ranks, given.runs))
for _, case in ipairs{ { "frictionless", "none" }, { "Coulomb 0.3", "0.3" } } do
  print(("\n%s\n   n  refine  unknowns   seconds (least to most)   GB of all ranks  kB an unknown  steps  iterations"):format(case[1]))
  local x <const>, y <const> = {}, {}
  for i, n in ipairs(sizes) do
    local refine, coarse = 0, n
    while coarse % 2 == 0 and coarse >= 16 do refine, coarse = refine + 1, coarse // 2 end
    local seconds <const>, s = {}, nil
    for k = 1, given.runs do
      s = own_process(study, "one", 1, n, given.ranks, refine, case[2], 2)
      seconds[k] = s.seconds
    end
    local bytes <const>, time <const> = s.bytes + s.others, median(seconds)
    x[i], y[i] = math.log(s.unknowns), math.log(time)
    print(("%4d %7d %9d %9.2f (%.2f to %.2f) %17.2f %14.2f %6d %11d"):format(n, refine, s.unknowns, time, math.min(table.unpack(seconds)),
      math.max(table.unpack(seconds)), bytes / 1e9, bytes / s.unknowns / 1e3, s.multigrid.newton, s.multigrid.cg))
  end
  if #sizes > 1 then print(("seconds grow as the unknowns to the power %.2f"):format((line(x, y)))) end
end
