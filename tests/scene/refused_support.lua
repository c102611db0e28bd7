-- Laws of supports that contradict others, or that mean nothing, are refused at the line that gives them.
local check <const> = require "check"
local refused <const> = require "refused"
local law <const> = dotyk.law

local it <const> = refused.pressed_block()
refused.intact = it.solve
local bottom <const>, top <const> = it.bottom, it.top
local cube <const> = dotyk.body{ name = "cube", material = it.material,
                                 mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {1,1,1} } }
local base <const> = cube:part "bottom"

-- What is given.
refused(function() top:support{} end, "support: name at least one law: normal or tangential")
refused(function() top:support() end, "support: name at least one law")
refused(function() top:support{ normal = 100 } end, "'normal' must be a law or a function, got the number 100")
refused(function() top:support{ normal = law.elastic } end, "elastic")
refused(function() top:support{ normal = law.signorini(), tangential = function(x) return x end } end, "expected a law")
refused(function() top:support{ normal = function(x) return x < 0.5 and law.elastic(1) or law.signorini() end } end, "the law is elastic at one node and Signorini at")
refused(function() top:support{ normal = function() return law.elastic(function() return 1 end) end } end, "gives them with numbers, and this is elastic a function")
refused(function() top:support{ normal = law.elastic(function(x) return -1 end) } end, "elastic law: k is -1 at", "it must be zero or positive, and finite")
refused(function() top:support{ normal = dotyk.friction.coulomb(1) } end, "a Coulomb friction law cannot be normal")
refused(function() top:support{ tangental = law.friction(1) } end, "unknown key 'tangental', did you mean 'tangential'?")
refused(function() top:support(law.elastic(1)) end, "support")
refused(function() law.one_sided_elastic(-1) end, "'k' must be")
refused(function() law.unequal_elastic(1, -1) end, "'k_pull' must be")
refused(function() law.unequal_elastic(1) end, "k_pull")
refused(function() law.friction(0/0) end, "'g' must be")
refused(function() it.body:part("none", function() return false end):support{ normal = law.signorini() } end, "part 'none' of 'block' is empty")

-- Tangential laws without meaning.
for _, one in ipairs{ law.signorini(), law.one_sided_elastic(1), law.one_sided_friction(1), law.breaking(1, 1), law.unequal_elastic(2, 1) } do
  refused(function() top:support{ tangential = one } end, "law cannot be tangential: slip to either side is alike",
    "in the plane is one of free, prescribed, load, elastic, friction and capped_elastic")
  refused(function() base:support{ tangential = one } end, "in space is one of free, prescribed(0), elastic and friction")
end
refused(function() base:support{ tangential = law.load(1) } end, "a load law cannot be tangential: it does not say along which tangent (part:load does)")
refused(function() base:support{ tangential = law.prescribed(0.1) } end, "it does not say along which tangent (part:displace does)")
refused(function() base:support{ tangential = law.capped_elastic(1, 1) } end, "a capped elastic law cannot be tangential")

-- Against other supports.
local bar <const> = dotyk.body{ name = "bar", mesh = it.mesh, material = it.material }
local foot <const> = bar:part "bottom"
foot:support{ normal = law.elastic(1) }
refused(function() foot:support{ normal = law.signorini() } end, "part 'bottom' of 'bar' has a normal law already, elastic")
local half <const> = bar:part("half", function(x, y) return y < 1e-9 and x < 0.5 end)
refused(function() half:support{ normal = law.elastic(2) } end, "part 'half' of 'bar' has a normal law already, elastic, as part of 'bottom'")
foot:support{ tangential = law.friction(1) }  -- the other direction may follow
refused(function() foot:support{ tangential = law.elastic(1) } end, "has a tangential law already, friction")
refused(function() foot:fix() end, "fix: contradictory supports on 'bar': the normal displacement of part 'bottom' is held at each of its nodes, and has the law elastic as well")
refused(function() foot:fix "x" end, "the tangential displacement of part 'bottom' is held at each of its nodes, and has the law friction as well")
refused(function() foot:slide() end, "slide: contradictory supports on 'bar': the normal displacement of part 'bottom'")
bar:part "left":fix()  -- holds one node of the part alone
local side <const> = bar:part "left"
refused(function() side:support{ normal = law.elastic(1) } end, "support: contradictory supports on 'bar': the normal displacement of part 'left' is held")
bar:part "top":load{ 0, -1 }
local s <const> = dotyk.solve(dotyk.scene{ bar })
check.that(s.converged)

-- A stiffness that is none, in the same words for bodies, beams and plates.
for _, k in ipairs{ 5e-324, 1e-310 } do
  local told <const> = (" law: the stiffness %g is lost in rounding beside any body's; leave that away, or make it stiffer"):format(k)
  for name, weak in pairs{ ["one-sided elastic"] = law.one_sided_elastic(k), elastic = law.elastic(k), ["unequal elastic"] = law.unequal_elastic(100, k) } do
    refused(function() top:support{ normal = weak } end, name .. told)
    refused(function() dotyk.solve(dotyk.beam{ load = -1, left = { deflection = weak }, right = { deflection = weak } }) end, name .. told)
    refused(function() dotyk.solve(dotyk.plate{ mesh = it.mesh, load = -1, edge = { deflection = weak } }) end, name .. told)
  end
end

-- A held node that cannot obey.
local held <const> = dotyk.body{ name = "held", mesh = it.mesh, material = it.material }
held:part "left":displace{ y = -0.1 }
held:part "bottom":support{ normal = law.signorini() }
refused(function() dotyk.solve(dotyk.scene{ held }) end, "contradictory supports on 'held': at the node (0, 0) the Signorini law of part 'bottom'", "differ by 0.1")

-- Results of what has none.
refused(function() s:support(bar:part "top") end, "part 'bar' top had no support by laws when it was solved; those that have: bottom")
refused(function() s:support(bottom) end, "is not of the scene that was solved")
refused(function() s:support() end, "argument 1 'part' is missing")

-- What the result says.
local r <const> = s:support(foot)
check.equal(#r.nodes, 3)
check.equal(r.open + r.closed, 3)
local fx <const>, fy <const> = s:reaction(foot)
check.near(r.force, { fx, fy }, 1e-14)
check.that(tostring(s):find("support of 'bar' bottom (normal elastic 1; tangential friction 1): force (", 1, true))
check.that(tostring(dotyk.scene{ bar }:plan()):find("on bottom (3 nodes): normal elastic 1; tangential friction 1", 1, true))

-- Methods that cannot treat a law say so before they start.
local soft <const> = dotyk.body{ name = "soft", mesh = it.mesh, material = it.material }
soft:part "bottom":support{ normal = law.one_sided_elastic(5) }
soft:part "left":slide()
soft:part "top":load{ 0, -1 }
local scene <const> = dotyk.scene{ soft }
for _, name in ipairs{ "active_set", "interior_point", "penalty" } do
  refused(function() dotyk.solver[name]{}:solve(scene) end, name, " cannot treat the one-sided elastic law of the normal support of 'soft' bottom; pdas can")
end
refused(function() dotyk.all_solutions(scene) end, "cannot treat the one-sided elastic law")
