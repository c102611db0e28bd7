-- Supports of beams and their laws: figures 1 to 17 of P4, drawn from solved beams.
--
--   ./dotyk scripts/examples/supports.lua
--
-- Every row is a beam that was solved: its deflection line, exaggerated, with the support that the row is about coloured by
-- what it does; the support's law, reaction against displacement, with the working point that the solution has on it; and the
-- superpotential, whose negative (sub)gradient the law is. Displacements that a law forbids are grey, there the
-- superpotential is infinite. images/supports_classical.png: figures 1 to 4, linear boundary conditions.
-- images/supports_elastic.png: 5, 6, 13 and 14, springs and one-sided springs. images/supports_unequal.png:
-- 15, springs that push with one stiffness and pull with another. images/supports_capped.png: 10, springs with a
-- greatest reaction. images/supports_one_sided.png: 7, Signorini's conditions.
-- images/supports_friction.png: 8 and 11, rigid friction; images/supports_one_sided_friction.png: 9 and 12. images/supports_breaking.png: 16 and 17, laws that are not monotone.
-- A table tells every working point.

local law <const> = dotyk.law
local clamped <const> = { deflection = law.prescribed(0), rotation = law.prescribed(0) }
local pinned <const> = { deflection = law.prescribed(0) }

-- A beam of length 1 and stiffness 1 with the given ends and loads, solved. Breaking: the branch in which all is whole, or broken.
local function solved(left, right, load, loads, broken)
  local s <const> = dotyk.solve(dotyk.beam{ cells = 16, left = left, right = right, load = load, loads = loads })
  for _, branch in ipairs(s.branches) do
    if (#branch.broken > 0) == (broken or false) then return branch end
  end
  return s
end

local function tip(force) return { { x = 1, force = force } } end
local function twist(moment) return { { x = 1, moment = moment } } end

local figures <const> = {
  { file = "supports_classical", title = "Classical boundary conditions", rows = {
    { title = "1. Clamped, with a settlement", support = "right", solution = solved(clamped, { deflection = law.prescribed(-0.01), rotation = law.prescribed(0) }, -1) },
    { title = "2. Free, loaded by a force and a moment", support = "right", solution = solved(clamped, { deflection = law.load(-0.3), rotation = law.load(0.1) }, -1) },
    { title = "3. Simply supported, with a settlement", support = "right", solution = solved(pinned, { deflection = law.prescribed(-0.01), rotation = law.load(0.05) }, -1) },
    { title = "4. Held against rotation, free to deflect", support = "right", of = "rotation", solution = solved(pinned, { rotation = law.prescribed(0.05), deflection = law.load(-0.1) }, -1) } } },
  { file = "supports_elastic", title = "Elastic supports", rows = {
    { title = "5, 13. Newton: elastic", support = "right", solution = solved(clamped, { deflection = law.elastic(20) }, -1) },
    { title = "5, 13. Newton: elastic about the rotation", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.elastic(4) }, -1) },
    { title = "6, 14. One-sided elastic, pushing", support = "right", solution = solved(clamped, { deflection = law.one_sided_elastic(20) }, -1) },
    { title = "6, 14. One-sided elastic, lifted off", support = "right", solution = solved(clamped, { deflection = law.one_sided_elastic(20) }, -1, tip(0.6)) },
    { title = "6, 14. One-sided elastic about the rotation", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.one_sided_elastic(4) }, -1) } } },
  { file = "supports_unequal", title = "Elastic supports of two stiffnesses", rows = {
    { title = "15. Pushing, the stiffer spring", support = "right", solution = solved(clamped, { deflection = law.unequal_elastic(20, 5) }, -1) },
    { title = "15. Pulling, the softer spring", support = "right", solution = solved(clamped, { deflection = law.unequal_elastic(20, 5) }, 1) },
    { title = "15. About the rotation, pushing", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.unequal_elastic(4, 1) }, -1) },
    { title = "15. About the rotation, pulling", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.unequal_elastic(4, 1) }, 1) } } },
  { file = "supports_capped", title = "Capped elastic supports: elastic friction", rows = {
    { title = "10. Capped elastic, within its limit", support = "right", solution = solved(clamped, { deflection = law.capped_elastic(20, 0.3) }, -0.7) },
    { title = "10. Capped elastic, at its limit", support = "right", solution = solved(clamped, { deflection = law.capped_elastic(20, 0.2) }, -1) },
    { title = "10. Capped elastic about the rotation, at its limit", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.capped_elastic(4, 0.03) }, -1) } } },
  { file = "supports_one_sided", title = "Signorini's conditions", rows = {
    { title = "7. Signorini, pushing", support = "right", solution = solved(clamped, { deflection = law.signorini() }, -1) },
    { title = "7. Signorini, lifted off", support = "right", solution = solved(clamped, { deflection = law.signorini() }, -1, tip(0.6)) },
    { title = "7. Signorini about the rotation, pushing", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.signorini() }, -1) },
    { title = "7. Signorini about the rotation, turned off", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.signorini() }, -1, twist(-0.3)) } } },
  { file = "supports_friction", title = "Rigid friction", rows = {
    { title = "8, 11. Friction, sticking", support = "right", solution = solved(clamped, { deflection = law.friction(0.5) }, -1) },
    { title = "8, 11. Friction, slipping", support = "right", solution = solved(clamped, { deflection = law.friction(0.2) }, -1) },
    { title = "8, 11. Friction about the rotation, slipping", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.friction(0.06) }, -1) } } },
  { file = "supports_one_sided_friction", title = "One-sided rigid friction", rows = {
    { title = "9, 12. One-sided friction, slipping", support = "right", solution = solved(clamped, { deflection = law.one_sided_friction(0.2) }, -1) },
    { title = "9, 12. One-sided friction, lifted off", support = "right", solution = solved(clamped, { deflection = law.one_sided_friction(0.2) }, -1, tip(0.6)) },
    { title = "9, 12. One-sided friction about the rotation, sticking", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.one_sided_friction(0.2) }, -1) } } },
  { file = "supports_breaking", title = "One-sided elastic supports that break", rows = {
    { title = "16. Whole", support = "right", solution = solved(clamped, { deflection = law.breaking(6, 0.3) }, -1) },
    { title = "16. Broken, under the same load", support = "right", solution = solved(clamped, { deflection = law.breaking(6, 0.3) }, -1, nil, true) },
    { title = "17. Whole, about the rotation", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.breaking(4, 0.1) }, -1) },
    { title = "17. Broken, under the same load", support = "right", of = "rotation", solution = solved(pinned, { deflection = law.prescribed(0), rotation = law.breaking(4, 0.1) }, -1, nil, true) } } } }

print "                                                       displacement     reaction"
for _, figure in ipairs(figures) do
  for _, row in ipairs(figure.rows) do
    local r <const> = row.solution:reaction(row.support)
    local v, f = r.deflection, r.force
    if row.of == "rotation" then v, f = r.rotation, r.moment end
    assert(row.solution.converged)
    print(("%-54s %12.6f %12.6f"):format(row.title, v, f))
  end
  dotyk.support_gallery{ file = "images/" .. figure.file .. ".png", title = figure.title, rows = figure.rows }
end
print "images/supports_classical.png, supports_elastic.png, supports_unequal.png, supports_capped.png, supports_one_sided.png, supports_friction.png, supports_one_sided_friction.png, supports_breaking.png"
