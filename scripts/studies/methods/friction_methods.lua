-- All methods for contact with friction on the same scenes: do they find the same solution, and at what cost?
--
--   ./dotyk scripts/studies/methods/friction_methods.lua [FINEST]
--
-- C2 and T2 (two blocks, Coulomb's and given friction), S3C (a punch in space), and the two blocks with their
-- left end lifted, on meshes of up to FINEST cells along the plane's interface (and a twelfth of that in space).
-- Each method's displacement against Newton's on a grid of points, node by node its status, and the energy
-- against other codes' (../shared/reference/other_codes.csv). Then T2 with less friction than the load needs:
-- every method refuses it with the same reason.
--
-- What the numbers say. Newton's method takes a handful of iterations on every mesh, the loop over given friction
-- a handful of Newton's solves. The first-order methods pay for the condition number of the compliance, which
-- grows like the number of nodes along the interface: iterations of Uzawa's method grow by that factor, those of
-- the conjugate gradients by about its root, over-relaxation's in between. The alternating algorithm of the report
-- hardly notices the mesh in the plane, as long as its steps are below Uzawa's bound (scripts/papers/tr965/alternating.lua); in space it
-- moves slipping forces by Uzawa's steps, and is as slow as those. Every method that says it converged has the same
-- solution; the proximal method, made for other problems, is the one that may say that it has not.

local finest <const> = tonumber(arg[1]) or 256
local shared <const> = (arg[0]:match "^(.*)/[^/]*$" or ".") .. "/../../../../shared"
local scenes <const> = include "../../lib/friction.lua"
local many <const> = { tol = 1e-11, max_iterations = 1000000 }

local methods <const> = {
  dotyk.solver.newton(many), dotyk.solver.coulomb_loop(many), dotyk.solver.proximal(many), dotyk.solver.uzawa_pdas(many),
  dotyk.solver.projected_cg(many), dotyk.solver.psor(many), dotyk.solver.uzawa(many) }

local function up_to(most, sizes)
  local list = {}
  for _, n in ipairs(sizes) do if n <= most then list[#list + 1] = n end end
  return list
end
local plane <const>, space <const> = up_to(finest, { 16, 64, 256 }), up_to(math.max(8, finest // 10), { 8, 16, 24 })
local coulomb <const>, given <const> = dotyk.friction.coulomb(0.3), dotyk.friction.tresca(2.5)
local cases <const> = {
  { "C2", scenes.blocks, coulomb, plane, "energy (elastic minus load work)" },
  { "T2", scenes.blocks, given, plane, "elastic energy minus load work" },
  { "S3C", scenes.cube, coulomb, space, "elastic energy" },
  { "C2 lifted", scenes.lifted, coulomb, plane }, { "T2 lifted", scenes.lifted, given, plane } }

-- Displacements on a grid of each body, and the status of each contact node.
local function sample(s, scene, contact)
  local u, status = {}, {}
  local flat = #scene.bodies == 2
  for b, body in ipairs(scene.bodies) do
    for i = 0, 10 do
      for j = 0, 10 do
        local point = flat and { i / 5, b - 1 + j / 10 } or { i / 10, j / 10, 1 }
        table.move({ s:displacement(body, table.unpack(point)) }, 1, #point, #u + 1, u)
      end
    end
  end
  for k, node in ipairs(s:contact(contact).nodes) do status[k] = node.status end
  return u, status
end

local function distance(u, v)
  local difference, size = 0, 0
  for k = 1, #u do difference, size = difference + (u[k] - v[k])^2, size + v[k]^2 end
  return math.sqrt(difference / size)
end

local references = 0
for _, case in ipairs(cases) do
  local name, build, law, sizes, quantity = table.unpack(case)
  for _, n in ipairs(sizes) do
    local scene, contact = build(n, law)
    local value = quantity and scenes.reference(shared, name, "n=" .. n, quantity)
    print(("\n%s, n = %d%s"):format(name, n, value and (": other codes' energy %.12g"):format(value) or ""))
    print "  method        iterations  seconds           energy  stick  slip  open   |du|/|u|  status differs"
    local first_u, first_status
    for _, method in ipairs(methods) do
      local s = method:solve(scene)
      if not s.converged then
        print(("  %-12s  %10d  %7.3f  %s"):format(s.method, s.iterations, s.time.iterate, s.reason))
        assert(s.method == "proximal", s.reason)
        goto next_method
      end
      local u, status = sample(s, scene, contact)
      first_u, first_status = first_u or u, first_status or status
      local differs = 0
      for k = 1, #status do if status[k] ~= first_status[k] then differs = differs + 1 end end
      local c, du = s:contact(contact), distance(u, first_u)
      print(("  %-12s  %10d  %7.3f  %15.12f  %5d %5d %5d   %8.1e  %d of %d"):format(
        s.method, s.iterations, s.time.iterate, s.energy, c.stick, c.slip, c.open, du, differs, #status))
      assert(du < 1e-7 and differs == 0)
      if value then
        assert(math.abs(s.energy - value) < 1e-10 * math.abs(value), "other codes' energy")
        references = references + 1
      end
      ::next_method::
    end
  end
end
print(("\n%d energies agree with other codes' to ten digits"):format(references))

print "\nT2 with g = 1.5: the load is 4, the interface carries 3"
local short <const> = scenes.blocks(16, dotyk.friction.tresca(1.5))
for _, method in ipairs(methods) do
  local solved, answer = pcall(method.solve, method, short)
  assert(not solved and answer:find("nothing stops 'upper': translation along x; the load does work 4", 1, true))
  print(("  %-12s %s"):format(tostring(method):match "^solver ([^:, ]+)", answer:match "not held: [^.]*"))
end
