#include "openings.hpp"

namespace dotyk::fuzz {

const std::vector<Opening> openings = {
    {"dotyk.law.signorini()", "dotyk.beam{ cells = 4, load = -1, left = { deflection = V[1] }, right = { deflection = V[1], rotation = dotyk.law.elastic(2) } }",
     "dotyk.solve(V[2])"},
    {"dotyk.beam{ cells = 3, load = -1, left = { deflection = dotyk.law.breaking(2, 1) }, right = { deflection = dotyk.law.elastic(2) } }",
     "dotyk.solve(V[1])"},
    {"dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {3,3} }", "dotyk.plate{ mesh = V[1], load = -1, edge = { deflection = dotyk.law.signorini() } }",
     "dotyk.solve(V[2])"},
    {"dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,3} }",
     "dotyk.plate{ mesh = V[1], load = -1, element = 'hct', edge = { deflection = dotyk.law.prescribed(0), rotation = dotyk.law.friction(0.1) } }", "dotyk.solve(V[2])"},
    {"dotyk.qp{ B = {{2,0},{0,2}}, c = {2,5}, D = {{1,1}}, d = {1}, x_low = 0 }", "V[1]:solve{}"},
    {"dotyk.lcp{ M = {{1,0,2},{2,1,0},{0,2,1}}, q = {1,-1,1} }"},
    {"dotyk.thermoelastic_beam{ height = 0.1, E = 100, expansion = 1e-3, conductivity = 1, heat_capacity = 1, cells = 4, load = -1, step = 1, "
     "left = { deflection = dotyk.law.signorini(), displacement = dotyk.law.prescribed(0) }, right = { deflection = dotyk.law.signorini() } }",
     "V[1]:run(2)"},
    {"dotyk.channel{ half_width = 1e-3, density = 13546, viscosity = 1.55e-3, conductivity = 1.04e6, E0 = 0.1, B0 = 0.2, pressure_gradient = -2e4, omega = 6.28, u0 = 1 }"},
    {"dotyk.mesh.rectangle{ from = {0,0}, to = {2,1}, cells = {3,2} }", "dotyk.mesh.rectangle{ from = {0,1}, to = {2,2}, cells = {3,2} }",
     "dotyk.material{ E = 10, nu = 0.3 }", "dotyk.body{ mesh = V[1], material = V[3] }", "dotyk.body{ name = 'other', mesh = V[2], material = V[3] }",
     "V[4]:part 'bottom':fix()", "V[5]:part 'top':load{ 0.02, -0.1 }", "dotyk.scene{ V[4], V[5] }",
     "V[8]:contact{ V[4]:part 'top', V[5]:part 'bottom', friction = dotyk.friction.coulomb(0.4) }",
     "dotyk.solve(V[8], { steps = { { load = 0.5 }, { load = 1 } } })"},
    {"dotyk.mesh.rectangle{ from = {-1,0}, to = {1,1}, cells = {4,2} }", "dotyk.body{ mesh = V[1], material = dotyk.material{ E = 100, nu = 0.3 } }",
     "V[2]:part 'top':load{ 0, -1 }", "V[2]:part 'left':fix 'x'", "V[2]:part 'bottom'", "dotyk.scene{ V[2] }",
     "V[6]:contact{ V[5], rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }",
     "dotyk.shape{ scene = V[6], moves = { { part = V[5], control_points = 4, direction = {0,1}, lower = 0, upper = 0.05 } } }", "V[8]:design{ 0.01, 0, 0, 0.01 }"},
    {"dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {2,1}, cells = {3,2} }, material = dotyk.material{ E = 10, nu = 0.3 } }", "V[1]:part 'bottom'",
     "V[1]:part 'top':load{ 0.1, -1 }", "V[1]:part 'left':fix 'x'", "V[2]:support{ normal = dotyk.law.signorini(), tangential = dotyk.law.friction(0.1) }",
     "dotyk.scene{ V[1] }", "dotyk.solve(V[6])", "V[7]:support(V[2])"},
    {"dotyk.body{ mesh = dotyk.mesh.box{ from = {0,0,0}, to = {4,1,1}, cells = {3,1,1}, element = 'Q1' }, material = dotyk.material{ E = 1, nu = 0.3 } }",
     "V[1]:part 'left':fix()", "V[1]:part 'right':load{ 0, 0, -1e-4 }",
     "dotyk.repeated_systems{ scene = dotyk.scene{ V[1] }, method = 'scg', velocities = { function(x, y, z) return 0, 0, z * (1 - x/8) end } }"},
    {"dotyk.mesh.rectangle{ from = {0,0}, to = {2,1}, cells = {2,2}, element = 'P2' }", "dotyk.mesh.rectangle{ from = {0,1}, to = {2,2}, cells = {3,2}, element = 'Q2' }",
     "dotyk.material{ E = 10, nu = 0.3 }", "dotyk.body{ mesh = V[1], material = V[3] }", "dotyk.body{ name = 'other', mesh = V[2], material = V[3] }",
     "V[4]:part 'bottom':fix()", "V[5]:part 'left':fix 'x'", "V[5]:part 'top':load{ 0.02, -0.1 }", "dotyk.scene{ V[4], V[5] }",
     "V[9]:contact{ V[4]:part 'top', V[5]:part 'bottom', friction = dotyk.friction.tresca(0.01) }", "dotyk.solve(V[9])"},
    {"dotyk.refinement{ dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} } }", "V[1]:refine()"},
    {"dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2}, element = 'P2' }", "dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {1,1,1}, element = 'Q2' }",
     "dotyk.body{ mesh = V[1], material = dotyk.material{ E = 100, nu = 0.3 } }", "dotyk.body{ name = 'other', mesh = V[2], material = dotyk.material{ E = 100, nu = 0.3 } }",
     "V[3]:part 'left':fix()", "V[4]:part 'left':fix()", "V[3]:part 'bottom'", "V[4]:part 'bottom'", "V[4]:part 'top':load{ 0, 0.1, -1 }", "dotyk.scene{ V[3] }", "dotyk.scene{ V[4] }",
     "V[10]:contact{ V[7], rigid = dotyk.rigid.ball{ center = {0.5,-1}, radius = 1 }, friction = dotyk.friction.coulomb(0.2) }",
     "V[11]:contact{ V[8], rigid = dotyk.rigid.plane{ point = {0,0,0}, normal = {0,0,1} } }", "dotyk.solve(V[10])", "dotyk.solve(V[11])", "V[14]:displacement(V[3], 0.5, 0.5)"},
    {"dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {3,2}, element = 'Q1' }", "dotyk.mesh.rectangle{ from = {-0.5,1}, to = {1.5,2}, cells = {4,2}, element = 'Q2' }",
     "dotyk.body{ mesh = V[1], material = dotyk.material{ E = 10, nu = 0.3 } }", "dotyk.body{ name = 'other', mesh = V[2], material = dotyk.material{ E = 20, nu = 0.2 } }", "V[3]:part 'bottom':fix()",
     "V[4]:part 'top':load{ 0.01, -0.1 }", "V[4]:part 'left':fix 'x'", "dotyk.scene{ V[3], V[4] }",
     "V[8]:contact{ V[3]:part 'top', V[4]:part 'bottom', pairing = 'mortar', friction = dotyk.friction.tresca(0.01) }", "dotyk.solve(V[8])", "V[10]:contact(V[9])"},
    {"dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {2,1,1}, element = 'P1' }", "dotyk.mesh.box{ from = {0,0,1}, to = {1,1,2}, cells = {1,2,1}, element = 'Q1' }",
     "dotyk.body{ mesh = V[1], material = dotyk.material{ E = 10, nu = 0.3 } }", "dotyk.body{ name = 'other', mesh = V[2], material = dotyk.material{ E = 20, nu = 0.2 } }", "V[3]:part 'bottom':fix()",
     "V[4]:part 'top':load{ 0, 0, -0.1 }", "V[4]:part 'left':fix 'x'", "V[4]:part 'front':fix 'y'", "dotyk.scene{ V[3], V[4] }",
     "V[9]:contact{ V[4]:part 'bottom', V[3]:part 'top', pairing = 'mortar' }", "dotyk.solve(V[9])"},
    {"dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} }, material = dotyk.material{ E = 10, nu = 0.3 } }", "V[1]:part 'bottom':fix()",
     "V[1]:part 'top':load{ 0.1, -1 }", "dotyk.scene{ V[1] }", "dotyk.solve(V[4])", "V[5]:write 'fuzz.vtu'", "dotyk.mesh.load('fuzz.vtu')", "V[7]:pieces()"},
    {"file('fuzz.mesh', 'MFEM mesh v1.0\\ndimension\\n2\\nelements\\n1\\n1 3 0 1 2 3\\nboundary\\n2\\n1 1 0 1\\n2 1 2 3\\nvertices\\n4\\n2\\n0 0\\n1 0\\n1 1\\n0 1\\n')", "dotyk.mesh.load 'fuzz.mesh'",
     "dotyk.body{ name = 'other', mesh = V[2], material = dotyk.material{ E = 10, nu = 0.3 } }", "V[3]:part '1':fix()", "V[3]:part '2':load{ 0, -1 }", "dotyk.scene{ V[3] }", "dotyk.solve(V[6])"},
    {"file('fuzz.dat', '2 2  0 4 4  4 4\\n2 0 1 0\\n0 1 0 0\\n1 0 2 0\\n0 0 0 1\\n-1 1 -1 0.5\\n0.3 0.2\\n')", "dotyk.fclib 'fuzz.dat'", "dotyk.solver.newton{}:solve(V[2])", "V[2]:solve(dotyk.solver.psor{})"},
    {"dotyk.adapt{ tol = 0.3, max_rounds = 3, mesh = dotyk.mesh.rectangle{ from = {-1,-1}, to = {1,0}, cells = {4,2} }, scene = function(mesh) "
     "local b = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 } } b:part 'bottom':fix() local s = dotyk.scene{ b } "
     "return s, s:contact{ b:part 'top', rigid = dotyk.rigid.gap{ normal = {0,1}, gap = function(x) return x^2 - 0.02 end } } end, on_round = function() odd.sweep() end }",
     "V[1]:error_estimate()"},
    {"dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} }, material = dotyk.material{ E = 10, nu = 0.3 } }",
     "V[1]:part 'left':fix()", "V[1]:part('top'):load({ 0.1, -1 }, 'wind')", "V[1]:part('right'):load({ 0.1, 0 }, 'snow')",
     "dotyk.repeated_systems{ scene = dotyk.scene{ V[1] }, loads = { 'wind', 'snow' }, method = 'block_cg' }", "V[5]:nodes(1)"},
    {"help()", "help(dotyk.solve)", "help 'mesh:transform'", "help(dotyk)", "help(dotyk.law.signorini())", "source(dotyk.adapt)"}};

const std::vector<Opening> pictures = {
    {"dotyk.chart{ file = 'fuzz.png', size = { 300, 200 }, series = { { name = 'a', x = { 1, 2, 3 }, y = { 1, 4, 9 } } } }"},
    {"dotyk.chart{ file = 'fuzz.png', size = { 300, 400 }, x = 'x', panels = { { log = 'y', series = { { x = { 1, 2 }, y = { 1, 0 }, low = { 0.5, 0 }, high = { 2, 1 } } } }, "
     "{ y = 'b', slopes = { 1 }, series = { { x = { 1 }, y = { 1 }, style = 'points' } } } } }"},
    {"dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2}, element = 'Q2' }, material = dotyk.material{ E = 10, nu = 0.3 } }", "V[1]:part 'left':fix 'x'",
     "V[1]:part 'top':load{ 0, -1 }", "dotyk.scene{ V[1] }", "V[4]:contact{ V[1]:part 'bottom', rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }", "dotyk.solve(V[4])",
     "V[6]:render{ file = 'fuzz.png', size = { 300, 200 }, supports = true, loads = true }"},
    {"dotyk.beam{ cells = 4, load = -1, left = { deflection = dotyk.law.signorini() }, right = { deflection = dotyk.law.signorini(), rotation = dotyk.law.elastic(2) } }", "dotyk.solve(V[1])",
     "V[2]:render{ file = 'fuzz.png' }"}};

}  // namespace dotyk::fuzz
