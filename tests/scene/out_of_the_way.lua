-- A body that nothing holds is pushed out of the way of a loaded one: the forces between them vanish, and rounding is all that is left of
-- them. The state is a solution, and is called one.
local check <const> = require "check"

local function block(name, from, to, E)
  return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = from, to = to, cells = {5, 4}, element = "P1" } }
end

local low <const>, high <const> = block("low", {0.1, 0}, {0.4, 0.25}, 1e5), block("high", {0, 0.25}, {0.5, 1}, 500)
local scene <const> = dotyk.scene{ low, high }
local contact <const> = scene:contact{ high:part "bottom", low:part "top", pairing = "mortar" }
low:part "bottom":support{ tangential = dotyk.law.friction(14) }
high:part "left":spring{ x = 4, y = 4 }
high:part "right":slide()
high:part "top":load{ 0, -190 }

-- Alone the upper block hangs on its springs.
local alone <const> = block("high", {0, 0.25}, {0.5, 1}, 500)
alone:part "left":spring{ x = 4, y = 4 }
alone:part "right":slide()
alone:part "top":load{ 0, -190 }
local free <const> = dotyk.solve(dotyk.scene{ alone })

for _, method in ipairs{ "newton", "proximal" } do
  local s <const> = dotyk.solver[method]{}:solve(scene)
  check.that(s.converged, s.reason)
  check.near(s.energy + s.friction_energy, free.energy, 1e-9 * -free.energy)
  check.that(s:contact(contact).max_pressure < 1e-9 * 190)
  check.that(s.residual.law <= 1e-10 and s.residual.penetration <= 1e-10)
end
