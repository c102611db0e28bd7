-- Stability atlas: stopped in the middle, by the user or by memory.
--
--   ./dotyk scripts/studies/stability/interrupted.lua [CELLS]
--
-- 1. Every method is stopped after its iteration k, by on_iteration returning false, as Ctrl-C does: the state so far
--    must come back whole (finite numbers, its fields and its contact readable), not converged, with that as the
--    reason; the next solve on the same scene and solver must end where an undisturbed one does, in as many
--    iterations.
-- 2. The program again as a process of its own, with less and less address space (ulimit -v): it must solve, or
--    refuse in words what does not fit, and never be killed or hang. The least space in which it solves is found by
--    bisection, for several sizes of a cube; whether a child that refused the cube then solves a small one is noted.
-- 3. That process is sent the signal of Ctrl-C while it solves one cube after the other, at several moments: it must end
--    with the word "interrupted", soon (a factorisation that has begun is ended first).
-- Draws images/stability_interrupted.png (2).

local n <const> = tonumber(arg[1]) or 16
local common <const>, scenes <const> = include "../../lib/common.lua", include "../../lib/friction.lua"

-- 1. Stopped by the user.
local coulomb <const>, given <const> = dotyk.friction.coulomb(0.3), dotyk.friction.tresca(2.5)
local function parabola() return common.punch(2 * n) end
local function rubbed() return scenes.lifted(n, coulomb) end
local function held() return scenes.lifted(n, given) end
local runs <const> = { { "pdas", parabola }, { "active_set", parabola }, { "interior_point", parabola }, { "penalty", parabola }, { "newton", rubbed },
  { "uzawa", held }, { "psor", rubbed }, { "projected_cg", held }, { "proximal", rubbed }, { "coulomb_loop", rubbed }, { "feti", held } }
local stops, torn = 0, {}
print "method          iterations  stopped after  reason"
for _, run in ipairs(runs) do
  local name, build = table.unpack(run)
  local scene, contact = build()
  local whole = dotyk.solver[name]{}:solve(scene)
  local places = {}
  for k = 1, math.min(3, whole.iterations - 1) do places[k] = k end
  if whole.iterations > 8 then places[#places + 1] = whole.iterations // 2 end
  local last = ""
  for _, k in ipairs(places) do
    local s = dotyk.solver[name]{ on_iteration = function(at) return at < k end }:solve(scene)
    local sum = s.energy + common.residual(s)
    for _, node in ipairs(s:contact(contact).nodes) do sum = sum + node.force + node.gap end
    local again = dotyk.solver[name]{}:solve(scene)
    stops, last = stops + 1, s.reason
    local done = s.converged and math.abs(s.energy - whole.energy) <= 1e-10 * math.abs(whole.energy) -- it was there already
    if not done and (s.converged or not (s.reason:find("interrupted", 1, true) or s.reason:find("stopped on request", 1, true))) or s.iterations > k + 1 or sum ~= sum or math.abs(sum) == math.huge
       or again.iterations ~= whole.iterations or again.energy ~= whole.energy then torn[#torn + 1] = name .. " after " .. k .. ": " .. s.reason end
  end
  print(("%-16s  %8d  %13s  %s"):format(name, whole.iterations, table.concat(places, ", "), last:sub(1, 90)))
end
for _, text in ipairs(torn) do print("not whole: " .. text) end

-- 2. Stopped by memory. The child tells what became of it.
local program <const> = io.popen("readlink /proc/$PPID/exe"):read "l"
local cubes <const> = [[
local function cube(n)
  local b = dotyk.body{ material = dotyk.material{ E = 1 }, mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {n,n,n} } }
  b:part"bottom":fix()
  local s = dotyk.scene{ b }
  s:contact{ b:part"top", rigid = dotyk.rigid.gap{ normal = {0,0,1}, gap = function(x, y) return ((x-0.5)^2 + (y-0.5)^2)/2 - 0.02 end } }
  return dotyk.solve(s)
end
]]
local child <const> = cubes .. [[
local ok, s = pcall(cube, %d)
print(ok and s.converged and "solved" or "refused " .. tostring(s))
local small, t = pcall(cube, 3)
print(small and t.converged and "small solved" or "small refused " .. tostring(t))
]]
local killed, seen = {}, {}
local function run(cells, megabytes)
  local pipe = io.popen(("OPENBLAS_NUM_THREADS=1; export OPENBLAS_NUM_THREADS; ulimit -v %d; timeout 120 '%s' -e '%s' 2>&1; echo status $?"):format(
    math.floor(megabytes * 1000), program, child:format(cells)))
  local text = pipe:read "a"
  pipe:close()
  local status = tonumber(text:match "status (%d+)%s*$")
  if text:find "^solved" then return "solved", text end
  if text:find("refused", 1, true) and status == 0 then
    if text:find("small solved", 1, true) then return "refused, then solves a small one", text end
    return "refused", text
  end
  if status == 1 and text:find("memory", 1, true) then return "refused", text end
  if status == 127 or text:find("shared lib", 1, true) then return "does not start", text end
  killed[#killed + 1] = ("%d cells, %g MB: %s"):format(cells, megabytes, text)
  return "killed or hung", text
end
local map <const> = common.map{ "solved", "refused, then solves a small one", "refused", "does not start", "killed or hung" }
local least = common.curve("least that solves, found", { style = "points" })
local first = run(3, 4000)
if first ~= "solved" then
  killed[1] = nil
  print "(the child does not run with a limit of its address space, as a sanitized program does not: part 2 is left out)"
else
  for _, cells in ipairs{ 4, n // 2, n, 5 * n // 4 } do
    for _, megabytes in ipairs{ 50, 100, 140, 180, 220, 260, 320, 400, 560, 800, 1600, 4000 } do
      local what, text = run(cells, megabytes)
      map:add(what, cells, megabytes)
      if not seen[what] then seen[what] = text end
    end
    least:add(cells, common.boundary(1 / 4000, 1 / 20, function(inverse) return run(cells, 1 / inverse) == "solved" end, 0.03)^-1)
  end
  print "\nwhat the children say, the first of each kind:"
  for what, text in pairs(seen) do print("  " .. what .. ": " .. text:gsub("%s+", " "):sub(1, 200)) end
  for _, text in ipairs(killed) do print("  killed: " .. text:gsub("%s+", " "):sub(1, 200)) end
  local series = map:series()
  series[#series + 1] = least
  dotyk.chart{ file = "images/stability_interrupted.png", log = "xy", x = "cells along the cube", y = "address space [MB]", series = series }
  print "images/stability_interrupted.png"
end
-- 3. Stopped by a signal.
local signals, deaf = 0, {}
for _, after in ipairs{ 0.02, 0.05, 0.1, 0.2, 0.35, 0.5 } do
  local pipe = io.popen(("timeout 120 '%s' -e '%s\nos.execute \"(sleep %g; kill -INT $PPID) &\"\nwhile true do cube(%d) end' 2>&1; echo status $?"):format(
    program, cubes, after, math.min(n, 12)))
  local text = pipe:read "a"
  pipe:close()
  signals = signals + 1
  if not text:find("interrupted\nstatus 1\n", 1, true) then deaf[#deaf + 1] = ("after %g s: %s"):format(after, text) end
end
for _, text in ipairs(deaf) do print("not interrupted: " .. text:gsub("%s+", " "):sub(1, 200)) end

common.verdict(#torn == 0 and #killed == 0 and #deaf == 0, ("stopped after any iteration, every method gives back a whole state and says that it was interrupted (%d stops), and the next solve is none the "
  .. "worse; Ctrl-C ends a running solve (%d signals); short of memory, the program refuses in words and goes on, or does not start, and is never killed nor hangs"):format(stops, signals))
