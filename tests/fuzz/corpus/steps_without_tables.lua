-- Loads and moves of steps that are no tables were read as if they were.
local refused <const> = require "refused"
local it <const> = refused.pressed_block()
for _, wrong in ipairs{ "text", true, print, it.floor } do
  refused(function() dotyk.solve(it.scene, { steps = { { load = wrong } } }) end, "'load' must be a factor, or a table of factors")
  refused(function() dotyk.solve(it.scene, { steps = { { move = wrong } } }) end, "'move' must be a table of displacements by contact")
end
refused(function() dotyk.solve(it.scene, { steps = { { move = 1 } } }) end, "'move' must be a table of displacements by contact")
