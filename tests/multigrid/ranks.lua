-- Several ranks, by dotyk.ranks, --ranks and mpirun: what is refused in words, the same answers as on one, and the end of all when one is killed.
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
local function told(code, options, by)
  local file = os.tmpname()
  local out <const> = assert(io.open(file, "w"))
  out:write(scene, code)
  out:close()
  local command <const> = "OPENBLAS_NUM_THREADS=1 timeout 250 %s '%s' %s '%s' 2>&1 </dev/null; echo status $?"
  local pipe <const> = io.popen(command:format(by or "", program, options or "", file))
  local text <const> = pipe:read "a"
  pipe:close()
  os.remove(file)
  return text
end
local function says(text, words, status)
  check.that(text:find(words, 1, true) and text:find("status " .. status, 1, true), text)
end
local function numbers(text)
  local all <const> = {}
  for line in text:gmatch "|(.-)|" do
    all[#all + 1] = {}
    for number in line:gmatch "%S+" do table.insert(all[#all], tonumber(number)) end
  end
  return all
end
local mpirun <const> = os.execute "command -v mpirun >/dev/null" and "mpirun --allow-run-as-root --oversubscribe -n 2"
if not mpirun then print "mpirun is not installed: not tested" end

if not told("cube(4)"):find("libpetsc", 1, true) then
  says(told "dotyk.ranks(2) dotyk.ranks(2) dotyk.ranks(3)", "there are 2 ranks already", 1)
  says(told "cube(4) dotyk.ranks(2)", "comes before the first solution by multigrid", 1)
  says(told("print(dotyk.ranks())", "--ranks 2"), "2\n", 0)
  says(told("", "--ranks 2.5"), "--ranks needs a whole number", 2)
  says(told("", "--safe /tmp --ranks 2"), "--safe starts no other programs", 2)
  says(told("dotyk.ranks(2)", "--safe /tmp"), "--safe starts no other programs", 1)
  says(told "print(dotyk.ranks()) dotyk.ranks(0)", "count", 1)
  -- Ctrl-C, most likely within an iteration: all ranks leave it, or the program would not end.
  says(told "dotyk.ranks(2) os.execute '(sleep 0.5; kill -INT $PPID) &' while true do cube(20) end", "interrupted", 1)
  -- A free block on a plane, of enough unknowns for coarser meshes: motions that no row notices are none of the answer.
  local free <const> = [[ local s, b = cube(12, true)
    local x, y = 0, 0
    for i = 0, 4 do for j = 0, 4 do local ux, uy = s:displacement(b, i / 4, j / 4, 0.5) x, y = x + ux / 25, y + uy / 25 end end
    print(("|%.12g|%.3g|%.3g|"):format(s.energy, x, y)) ]]
  -- What a script prints on several ranks is what it prints on one.
  local function same(code, ...)
    local alone <const> = numbers(told(code))[1]
    check.that(alone and #alone > 0, "no numbers")
    for _, ranks in ipairs{ ... } do
      local text <const> = ranks == "mpirun" and told("assert(dotyk.ranks() == 2)" .. code, "", mpirun) or told(code, "--ranks " .. ranks)
      check.that(text:find "status 0" and #numbers(text) == 1 and #numbers(text)[1] == #alone, text)
      for k, number in ipairs(alone) do check.near(numbers(text)[1][k], number, 1e-9 * math.abs(number), "number " .. k .. " on " .. ranks .. " ranks") end
    end
  end
  -- Small pieces, most of whose rows are beside other ranks' and coupled by the rows of the glue: sweeps of each rank alone would diverge. FETI
  -- and beams stay on rank 0.
  same([[ local function block(name, from, to, n)
      return dotyk.body{ name = name, material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.box{ from = from, to = to, cells = {n, n, n // 2} } }
    end
    local function glued(n)
      local lower, upper = block("lower", {0, 0, 0}, {1, 1, 0.5}, n), block("upper", {0, 0, 0.5}, {1, 1, 1}, n - 1)
      lower:part"bottom":fix()
      upper:part"top":displace{ x = 0, y = 0, z = -0.01 }
      local scene = dotyk.scene{ lower, upper }
      scene:glue{ upper:part"bottom", lower:part"top" }
      return scene
    end
    local signorini = { deflection = dotyk.law.signorini() }
    local beam = dotyk.beam{ cells = 20, load = -1, left = signorini, right = signorini }
    local large, small = dotyk.solver.multigrid{}:solve(glued(16)), dotyk.solver.feti{}:solve(glued(6))
    print(("|%.12g %.12g %.12g|"):format(large.energy, small.energy, dotyk.solve(beam):deflection(0.5))) ]],
    4, 8, mpirun and "mpirun")
  -- Points that slip: conjugate residuals on vectors that lie with the ranks.
  same([[ local b = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {12,12,12} } }
    b:part"bottom":fix()
    local s = dotyk.scene{ b }
    s:contact{ b:part"top", rigid = dotyk.rigid.gap{ normal = {0, 0, 1}, gap = function(x, y) return ((x - 0.5)^2 + (y - 0.5)^2) / 2 - 0.05 end }, friction = dotyk.friction.coulomb(0.3), interference = true }
    print(("|%.12g|"):format(dotyk.solver.multigrid{}:solve(s).energy)) ]], 3)
  for _, ranks in ipairs{ 1, 2 } do
    local text <const> = told("dotyk.ranks(" .. ranks .. ")" .. free)
    local energy <const>, x <const>, y <const> = text:match "|(.-)|(.-)|(.-)|"
    check.that(energy, text)
    check.near(tonumber(energy), -0.05, 1e-10)
    check.that(math.abs(tonumber(x)) < 1e-8 and math.abs(tonumber(y)) < 1e-8, "the block has moved: " .. text)
  end

  -- Bodies that ranks refine: the numbers of one process, which has the whole meshes. Two bodies whose meshes do not match; triangles of order 2; a mesh that has
  -- coarser ones of its own; a support smaller than the coarse cells; two bodies that nothing joins, one of them of aggregates.
  local refined = [[
    local function material(E) return dotyk.material{ E = E, nu = 0.3 } end
    local function say(s, c, body, part, ...)
      local numbers = { s.multigrid.cg, s.multigrid.levels, s.unknowns, s.rows, s.energy, s:contact(c).area, s:stress(body, ...).von_mises }
      for _, list in ipairs{ s:contact(c).force, { s:displacement(body, ...) }, { s:reaction(part) } } do for i = 1, #list do numbers[#numbers + 1] = list[i] end end
      for i, number in ipairs(numbers) do numbers[i] = ("%.13g"):format(number) end
      print("|" .. table.concat(numbers, " ") .. "|")
    end
    local function blocks()
      local function block(name, from, to, n, E)
        return dotyk.body{ name = name, material = material(E), refine = 1, mesh = dotyk.mesh.box{ from = from, to = to, cells = {n, n, 4} } }
      end
      local lower, upper = block("lower", {0,0,0}, {1,1,0.5}, 6, 1000), block("upper", {0,0,0.5}, {1,1,1}, 8, 500)
      lower:part"bottom":fix()
      upper:part"top":displace{ x = 0.001, y = 0, z = -0.01 }
      local scene = dotyk.scene{ lower, upper }
      local c = scene:contact{ upper:part"bottom", lower:part"top", friction = dotyk.friction.coulomb(0.3) }
      say(dotyk.solver.multigrid{}:solve(scene), c, lower, lower:part"bottom", 1, 0.5, 0.25)
    end
    local function plane()
      local soft = dotyk.body{ name = "soft", material = dotyk.material{ E = function(x) return x < 0.5 and 1000 or 2000 end, nu = 0.3 }, refine = 3,
                               mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {6,6}, element = "P2" } }
      soft:part"left":displace{ x = 0, y = 0 }
      soft:part"right":slide()
      soft:part"top":load{ 0, -20 }
      local scene = dotyk.scene{ soft }
      local c = scene:contact{ soft:part"bottom", rigid = dotyk.rigid.gap{ normal = {0,-1}, gap = function(x) return 0.02 * x end } }
      say(dotyk.solver.multigrid{}:solve(scene), c, soft, soft:part"left", 0.5, 1)
    end
    local function cube()
      local b = dotyk.body{ material = material(1000), refine = 2, mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {4,4,4}, element = "Q1" } }
      b:part"bottom":fix()
      b:part"left":support{ normal = dotyk.law.elastic(100) }
      local scene = dotyk.scene{ b }
      local c = scene:contact{ b:part"top", rigid = dotyk.rigid.gap{ normal = {0,0,1}, gap = function(x, y) return ((x - 0.5)^2 + (y - 0.5)^2) / 2 - 0.05 end }, interference = true }
      say(dotyk.solver.multigrid{}:solve(scene), c, b, b:part"bottom", 1, 0.5, 0.75)
    end
    -- Midside nodes: rows of contact that several ranks' unknowns share, solved exactly beside sweeps of small pieces.
    local function quadratic()
      local b = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.4 }, refine = 1, mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,0.5}, cells = {4,4,2}, element = "Q2" } }
      b:part"bottom":fix()
      local scene = dotyk.scene{ b }
      local c = scene:contact{ b:part"top", rigid = dotyk.rigid.ball{ center = {0.5,0.5,2.48}, radius = 2 }, interference = true }
      say(dotyk.solver.multigrid{}:solve(scene), c, b, b:part"bottom", 1, 0.5, 0.25)
    end
    local function clamped()
      local b = dotyk.body{ material = material(1000), refine = 3, mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {2,2,2} } }
      local clamp = b:part("clamp", function(x, y, z) return x == 0 and y < 0.4 and z < 0.4 end)
      clamp:fix()
      b:part"right":load{ 0, 0, -1 }
      local scene = dotyk.scene{ b }
      local c = scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0,0,-0.01}, normal = {0,0,1} } }
      say(dotyk.solver.multigrid{}:solve(scene), c, b, clamp, 1, 0.5, 0.75)
    end
    local function apart()
      local function pressed(name, x, n, depth)
        local b = dotyk.body{ name = name, material = material(1000), refine = 1, mesh = dotyk.mesh.box{ from = {x,0,0}, to = {x + 1,1,1}, cells = {n,n,n} } }
        b:part"bottom":fix()
        return b, { b:part"top", rigid = dotyk.rigid.gap{ normal = {0,0,1}, gap = function(x, y) return (x - 0.5)^2 / 2 + (y - 0.5)^2 / 2 - depth end }, interference = true }
      end
      local one, on_one = pressed("one", 0, 13, 0.02)
      local two, on_two = pressed("two", 5, 4, -9)
      local scene = dotyk.scene{ one, two }
      local c = scene:contact(on_one)
      scene:contact(on_two)
      say(dotyk.solver.multigrid{}:solve(scene), c, one, one:part"bottom", 1, 0.5, 0.75)
    end
    -- Contact alone holds the upper body, springs hold the lower one, whose stiffness jumps; forces per volume, one of them a function, in steps. Values inside, and
    -- estimates, of each step.
    local function loaded()
      local upper = dotyk.body{ name = "upper", material = material(500), refine = 1, force = {0, 0, -20}, mesh = dotyk.mesh.box{ from = {0,0,0.5}, to = {1,1,1}, cells = {5, 5, 3}, element = "Q1" } }
      local lower = dotyk.body{ name = "lower", material = dotyk.material{ E = function(x) return x < 0.5 and 1000 or 3000 end, nu = 0.3 }, refine = 1,
                                force = function(x, y, z) return x * y, 2 * z, -10 - x * x end, mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,0.5}, cells = {6, 6, 4} } }
      upper:part"left":slide()
      upper:part"front":slide()
      lower:part"bottom":spring{ x = 900, y = 700, z = 2000 }
      lower:part"left":displace{ x = 0.002, case = "push" }
      local scene = dotyk.scene{ lower, upper }
      local c = scene:contact{ upper:part"bottom", lower:part"top", friction = dotyk.friction.coulomb(0.3) }
      local s = dotyk.solver.multigrid{}:solve(scene, { steps = { { load = 0.5 }, { load = { push = 1 } } } })
      for _, step in ipairs(s.steps) do
        local relative, parts = step:error_estimate()
        for _, name in ipairs{ "recovery", "bulk", "jump", "boundary", "contact_pressure" } do print(("|%.13g|"):format(parts[name])) end
        print(("|%.13g %.13g|"):format(relative, step.energy))
        say(step, c, lower, lower:part"bottom", 0.48, 0.51, 0.23)
      end
      -- How many cells all pieces have, and the least and the greatest values of each array.
      local cells, least, greatest = 0, {}, {}
      s:write(FILE .. ".pvtu")
      for name in io.open(FILE .. ".pvtu"):read"a":gmatch 'Source="(.-)"' do
        local piece = FILE:match"(.*/)" .. name
        local text = io.open(piece, "rb"):read"a"
        cells = cells + tonumber(text:match 'NumberOfCells="(%d+)')
        for array, from, to in text:gmatch 'Name="([%a_]+)"[^>]-RangeMin="(%S+)%s*" +RangeMax="(%S+)%s*"' do
          least[array], greatest[array] = math.min(least[array] or 1e300, tonumber(from)), math.max(greatest[array] or -1e300, tonumber(to))
        end
        os.remove(piece)
      end
      os.remove(FILE .. ".pvtu")
      print(("|%d|"):format(cells))
      for _, array in ipairs{ "displacement", "stress", "von_mises", "contact_pressure", "contact_status" } do
        print(("|%.9g %.9g|"):format(least[array], greatest[array]))
      end
    end
    blocks() plane() cube() quadratic() clamped() apart() loaded() ]]
  local file <const> = os.tmpname()
  refined = ("local FILE = %q\n"):format(file) .. refined
  local alone <const> = numbers(told(refined))
  check.that(#alone == 6 + 2 * 7 + 1 + 5, "six scenes on one rank, and one in two steps")
  for _, ranks in ipairs{ 2, 3, 5 } do
    local text <const> = ranks == 2 and mpirun and told(refined, "", mpirun) or told(refined, "--ranks " .. ranks)
    local several <const> = numbers(text)
    check.that(#several == #alone, text)
    for k, own in ipairs(alone) do
      local greatest = 0  -- of displacements and forces, whose components may vanish
      for i = 8, #own do greatest = math.max(greatest, math.abs(own[i])) end
      for i, number in ipairs(own) do
        -- Most nodes of pieces as small as these are next to other ranks': there iterations are up to a sixth more. Other processors round differently.
        check.near(several[k][i], number, #own > 5 and i == 1 and 0.3 * number or 1e-9 * (i <= 7 and math.abs(number) or greatest))
      end
    end
  end

  os.remove(file)

  local body <const> = [[dotyk.ranks(2)
    local function body(more)
      local all = { name = "b", material = dotyk.material{ E = 1000, nu = 0.3 }, refine = 2, mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {4,4,4} } }
      for k, v in pairs(more or {}) do all[k] = v end
      return dotyk.body(all)
    end
    local function held(more) local b = body(more) b:part"bottom":fix() b:part"top":load{0, 0, -1} return b end
    local function solved(...) return dotyk.solver.multigrid{}:solve(dotyk.scene{ ... }) end
    ]]
  local function refused(code, words) says(told(body .. code), words, 1) end
  refused("dotyk.solver.pdas{}:solve(dotyk.scene{ held() })", "dotyk.solver.multigrid{} works there")
  refused("dotyk.solver.multigrid{ levels = 'aggregates' }:solve(dotyk.scene{ held() })", "dotyk.solver.multigrid{} works there")
  refused("solved(body())", "'b' is not held")
  refused("local b = body{ force = {0, 0, -1} } local s = dotyk.scene{ b } s:contact{ b:part'bottom', rigid = dotyk.rigid.plane{ point = {0,0,0}, normal = {0,0,1} } } dotyk.solver.multigrid{}:solve(s)",
          "nothing notices 'b'")
  refused("solved(held(), held{ name = 'c', refine = 1 })", "on several ranks all bodies of a scene have the same")
  refused("solved(held()):distance(solved(held()))", "a distance of solutions needs them")
  refused("solved(held()):write('/nowhere/a.pvtu')", "/nowhere")
  refused("solved(held()):render{ file = os.tmpname() .. '.png', cut = { point = {0.5, 0.5, 0.5}, normal = {0, 1, 0} } }", "a cut needs them")
  refused("local b = held() solved(b):displacement(b, 0.5, 0.5, 1.5)", "lies outside 'b' at rest")
  says(told(body .. "local b = held() print(b, b.node_count, b.cell_count) print(dotyk.scene{ b }:plan()) print(dotyk.solve(dotyk.scene{ b }))"), "4913 nodes", 0)

  if mpirun then
    -- Under mpirun its number of ranks stands, whatever the script asks for. After a solution a script may start mpirun itself.
    says(told("print('|' .. dotyk.ranks(3) .. '|')", "", mpirun), "|2|", 0)
    says(told("cube(4) os.execute [[" .. mpirun .. " '" .. program .. "' -e 'print(\"|\" .. dotyk.ranks())']]"), "|2", 0)
    -- A rank of another build must be refused: its messages would not match.
    local other <const> = os.tmpname()
    os.execute(("cp '%s' '%s' && echo >>'%s' && chmod +x '%s'"):format(program, other, other, other))
    local both <const> = told("", ("-e 'print(1)' : -n 1 '%s'"):format(other), mpirun:gsub("%-n 2", "-n 1"))
    os.remove(other)
    check.that(both:find("the ranks are different builds of dotyk", 1, true) and not both:find("status 0", 1, true), both)

    -- A rank that is killed while it solves ends all that mpirun has started.
    local dies <const> = told([[
      os.execute [=[ranks=$(cat /proc/$(cut -d ' ' -f 4 /proc/$PPID/stat)/task/*/children); echo "|$ranks|"
        (sleep 1; for r in $ranks; do [ $r = $PPID ] || kill -9 $r; done) &]=]
      while true do cube(20) end ]], "", mpirun)
    local first <const>, second <const> = dies:match "|(%d+) (%d+) |"
    check.that(first and dies:find "status [1-9]" and not dies:find "status 124", dies)
    local state <const> = ("grep -s '^State:.[^ZX]' /proc/%d/status /proc/%d/status"):format(first, second)
    check.that(os.execute("for i in $(seq 50); do " .. state .. " >/dev/null || exit 0; sleep 0.1; done; exit 1"), "a rank is left")
  end
end
