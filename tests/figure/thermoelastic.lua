-- Figures of thermoelastic beams and of charts in panels, as a script asks for them.
local check <const> = require "check"
local refused <const> = require "refused"
local size <const> = require "png_size"
local law <const> = dotyk.law

local function beam(keys)
  local all = { length = 2, height = 0.1, E = 1e6, expansion = 1e-3, conductivity = 5, heat_capacity = 100, exchange = { above = 2, below = 1 },
    ambient = { above = 10 }, left = { deflection = law.prescribed(), rotation = law.prescribed(), displacement = law.prescribed() },
    right = { deflection = law.signorini() }, supports = { { x = 1, deflection = law.elastic(3) } }, load = -1, step = 0.1 }
  for key, value in pairs(keys or {}) do all[key] = value end
  return dotyk.thermoelastic_beam(all)
end
local bytes <const> = require "bytes_of"

local b <const> = beam():run(1)
check.equal(b:render{ file = "thermo.png" }, "thermo.png")
check.equal(size "thermo.png"[1], 1000)
check.that(size "thermo.png"[2] >= 60 + 400 + 3 * 250)
local names <const> = { "deflection", "moment", "shear", "normal", "temperature", "gradient", "displacement" }
b:render{ file = "thermo.png", panels = names, title = "T", units = { length = "m", force = "N", temperature = "K" } }
check.that(size "thermo.png"[2] >= 60 + 400 + 6 * 250)
for _, name in ipairs(names) do b:render{ file = "thermo.png", panels = { name }, size = { 400, 200 } } end
check.equal(size "thermo.png", { 400, 200 })
for _, of in ipairs{ "deflection", "rotation", "displacement" } do check.equal(b:render_law{ file = "law.png", support = "right", of = of }, "law.png") end
b:render_law{ file = "law.png", support = 1 }

-- The present time, and the load at that time.
local falling <const> = beam{ load = function(_, t) return -1 - t end }
falling:run(1):render{ file = "a.png" }
falling:run(2):render{ file = "b.png" }
check.that(bytes "a.png" ~= bytes "b.png")
beam{ load = function(_, t) return -1 - t end }:run(1):render{ file = "b.png" }
check.equal(bytes "a.png", bytes "b.png")

refused(function() b:render{} end, "'file'")
refused(function() b:render{ file = "thermo.png", panels = { "temprature" } } end, 'did you mean "temperature"?')
refused(function() b:render{ file = "thermo.png", panels = {} } end, "'panels'")
refused(function() b:render{ file = "thermo.png", units = { temprature = "K" } } end, "did you mean 'temperature'?")
refused(function() b:render{ file = "nowhere/thermo.png" } end, "nowhere")
refused(function() b:render_law{ file = "law.png", support = "right", of = "displacment" } end, 'did you mean "displacement"?')
refused(function() b:render_law{ file = "law.png", support = 1, of = "displacement" } end, "no law about the displacement")
refused(function() b:render_law{ file = "law.png", support = 0.7 } end, "no support there; the supports are left, x = 1, right")

-- A load that draws, or that fails when it is asked for drawing; after either the beam goes on.
local own, trouble
own = beam{ load = function()
  if trouble == "draw" then own:render{ file = "thermo.png" } end
  if trouble == "fail" then error "no load today" end
  return -1
end }
trouble = "draw"
check.that(select(2, pcall(own.render, own, { file = "thermo.png" })):find("a function of its loads cannot draw it", 1, true))
check.that(select(2, pcall(own.step, own)):find("a function of its loads cannot draw it", 1, true))
trouble = "fail"
check.that(select(2, pcall(own.render, own, { file = "thermo.png" })):find("no load today", 1, true))
trouble = nil
own:step():render{ file = "thermo.png" }
local wild <const> = beam{ load = function(_, t) return t > 0.05 and t < 0.15 and trouble and 0/0 or -1 end }:step()
trouble = true
refused(function() wild:render{ file = "thermo.png" } end, "load")

-- Charts in panels.
local function curve(y) return { { x = { 1, 2 }, y = { y, 2 * y } } } end
check.equal(dotyk.chart{ file = "panels.png", x = "time", title = "T", panels = { { y = "a", series = curve(1) }, { title = "b", series = curve(2), log = "y" } } }, "panels.png")
check.equal(size "panels.png"[1], 1000)
check.that(size "panels.png"[2] >= 60 + 2 * 260)
dotyk.chart{ file = "panels.png", size = { 500, 600 }, panels = { { x = "a", series = curve(1), log = "x" }, { x = "b", series = curve(2), slopes = { 1 } } } }
check.equal(size "panels.png", { 500, 600 })
refused(function() dotyk.chart{ file = "p.png" } end, "missing key 'series'", "'panels'")
refused(function() dotyk.chart{ file = "p.png", panels = {} } end, "'panels'")
refused(function() dotyk.chart{ file = "p.png", panels = { { series = curve(1) } }, series = curve(1) } end, "'series' beside 'panels'")
refused(function() dotyk.chart{ file = "p.png", panels = { { series = curve(1) } }, log = "x" } end, "'log' beside 'panels'")
refused(function() dotyk.chart{ file = "p.png", panels = { { y = "a" } } } end, "series")
refused(function() dotyk.chart{ file = "p.png", panels = { { serie = curve(1) } } } end, "did you mean 'series'?")
refused(function() dotyk.chart{ file = "p.png", x = "t", panels = { { series = curve(1) }, { x = "u", series = curve(1) } } } end, "panel 2 has an 'x'")
refused(function() dotyk.chart{ file = "p.png", x = "t", panels = { { series = curve(1) }, { log = "x", series = curve(1) } } } end, "panel 2 is logarithmic in x, the first one is not")
