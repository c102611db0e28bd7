-- Several ranks from a script: what is refused in words, and that a free body's answer is the same.
local check <const> = require "check"
if not pcall(dotyk.solver.multigrid) then return end
local program <const> = io.popen("readlink /proc/$PPID/exe"):read "l"

local scene <const> = [[
local function cube(n, free)
  local b = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {n,n,n} } }
  local s = dotyk.scene{ b }
  if free then
    b:part"top":load{ 0, 0, -10 }
    s:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0,0,0}, normal = {0,0,1} } }
  else
    b:part"bottom":fix()
    b:part"top":load{ 0, 0, -10 }
  end
  return dotyk.solver.multigrid{}:solve(s), b
end
]]
local function told(code, options)
  local file = os.tmpname()
  local out <const> = assert(io.open(file, "w"))
  out:write(scene, code)
  out:close()
  local pipe <const> = io.popen(("OPENBLAS_NUM_THREADS=1 timeout 60 '%s' %s '%s' 2>&1; echo status $?"):format(program, options or "", file))
  local text <const> = pipe:read "a"
  pipe:close()
  os.remove(file)
  return text
end
local function says(text, words, status)
  check.that(text:find(words, 1, true) and text:find("status " .. status, 1, true), text)
end

if not told("cube(4)"):find("libpetsc", 1, true) then
  says(told "dotyk.ranks(2) dotyk.ranks(2) dotyk.ranks(3)", "there are 2 ranks already", 1)
  says(told "cube(4) dotyk.ranks(2)", "comes before the first solution by multigrid", 1)
  says(told("print(dotyk.ranks())", "--ranks 2"), "2\n", 0)
  says(told("", "--ranks 2.5"), "--ranks needs a whole number", 2)
  says(told("", "--safe /tmp --ranks 2"), "--safe starts no other programs", 2)
  says(told("dotyk.ranks(2)", "--safe /tmp"), "--safe starts no other programs", 1)
  says(told "print(dotyk.ranks()) dotyk.ranks(0)", "count", 1)
  -- A free block on a plane, of enough unknowns for coarser meshes: motions that no row notices are none of the answer.
  local free <const> = [[ local s, b = cube(12, true)
    local x, y = 0, 0
    for i = 0, 4 do for j = 0, 4 do local ux, uy = s:displacement(b, i / 4, j / 4, 0.5) x, y = x + ux / 25, y + uy / 25 end end
    print(("|%.12g|%.3g|%.3g|"):format(s.energy, x, y)) ]]
  -- Small pieces, most of whose rows are beside other ranks' and coupled by the rows of the glue: sweeps of each rank alone would diverge.
  local glued <const> = [[ local function block(name, from, to, n)
      return dotyk.body{ name = name, material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.box{ from = from, to = to, cells = {n, n, 8} } }
    end
    local lower, upper = block("lower", {0, 0, 0}, {1, 1, 0.5}, 16), block("upper", {0, 0, 0.5}, {1, 1, 1}, 15)
    lower:part"bottom":fix()
    upper:part"top":displace{ x = 0, y = 0, z = -0.01 }
    local scene = dotyk.scene{ lower, upper }
    scene:glue{ upper:part"bottom", lower:part"top" }
    print(("|%.12g|"):format(dotyk.solver.multigrid{}:solve(scene).energy)) ]]
  local energies <const> = {}
  for _, ranks in ipairs{ 1, 4 } do energies[ranks] = tonumber(told("dotyk.ranks(" .. ranks .. ")" .. glued):match "|(.-)|") end
  check.near(energies[4], energies[1], 1e-9 * energies[1])
  -- Points that slip: conjugate residuals on vectors that lie with the ranks.
  local slips <const> = [[ local b = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {12,12,12} } }
    b:part"bottom":fix()
    local s = dotyk.scene{ b }
    s:contact{ b:part"top", rigid = dotyk.rigid.gap{ normal = {0, 0, 1}, gap = function(x, y) return ((x - 0.5)^2 + (y - 0.5)^2) / 2 - 0.05 end }, friction = dotyk.friction.coulomb(0.3), interference = true }
    print(("|%.12g|"):format(dotyk.solver.multigrid{}:solve(s).energy)) ]]
  for _, ranks in ipairs{ 1, 3 } do energies[ranks] = tonumber(told("dotyk.ranks(" .. ranks .. ")" .. slips):match "|(.-)|") end
  check.near(energies[3], energies[1], 1e-9 * energies[1])
  for _, ranks in ipairs{ 1, 2 } do
    local text <const> = told("dotyk.ranks(" .. ranks .. ")" .. free)
    local energy <const>, x <const>, y <const> = text:match "|(.-)|(.-)|(.-)|"
    check.that(energy, text)
    check.near(tonumber(energy), -0.05, 1e-10)
    check.that(math.abs(tonumber(x)) < 1e-8 and math.abs(tonumber(y)) < 1e-8, "the block has moved: " .. text)
  end
end
