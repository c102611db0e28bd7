-- Foundations under beams, with the laws of supports: Horák (ODAM 2001, section 4) proposes them and has no example.
--
--   ./dotyk scripts/papers/beam_foundations.lua [CELLS]
--
-- 1. A long beam is pressed by a force P in the middle. Lengths are scaled by λ = (k/4EJ)^(1/4), pressures by λP/2, deflections by λP/2k;
--    x is counted from the force. Per length the foundation bears
--    Winkler     -k u:         u = -e^{-λx} (cos λx + sin λx);
--    one-sided   k u⁻:         touches over |x| < π/2λ whatever P, and there it is Hetényi's beam of that length with free ends;
--    capped      -k u, ≤ g:    yields over |x| < a, with λP/2g = (2/3 α³ + 2α² + 2α + 1)/(1 + α)², α = λa. Beyond a u is a decaying wave from
--                              u(a) = -g/k, within it a polynomial of degree 4. Here α = 1, λP/2g = 17/12.
-- 2. A clamped beam under the load q meets a rigid floor, u ≥ h(x), h = -d + ½κ (x - L/2)². It hangs free over 0 < x < a, where u, u' and u"
--    reach h, h' and h" at a: u = h(a) - h'(a) s + ½κ s² + A s³ - q/24EJ s⁴ with s = a - x; u(0) = u'(0) = 0 give A and a. The floor bears
--    q where they touch, and forces 6EJ A where they part.
-- Checked: against these closed forms with order 2 in the cells, pressures by the balance of forces, and PDAS against a second method.
-- CELLS: along the beam of part 2, and half of those along the long beam. Draws images/papers_beam_foundations.png.

local most <const> = math.tointeger(tonumber(arg[1]) or 640)
local law <const> = dotyk.law
local common <const> = dofile((arg[0]:match "^(.*)/[^/]*$" or ".") .. "/../stability/common.lua")
local function ch(t) return (math.exp(t) + math.exp(-t)) / 2 end
local function sh(t) return (math.exp(t) - math.exp(-t)) / 2 end

-- 1. EJ = 1, k = 4, so that λ = 1; P = 2: pressures and 4u are scaled. Closed forms: -k u over x.
local half <const>, EJ <const>, k <const>, P <const> = 10, 1, 4, 2
local function winkler(x) return math.exp(-x) * (math.cos(x) + math.sin(x)) end
local contact <const> = math.pi / 2
local A <const>, B <const> = (function()
  local c <const>, s <const> = ch(contact), sh(contact) -- cos is 0 and sin 1 in the middle
  local a <const>, b <const> = 0, c -- w' = A (sc - cs) + 2B cc = 0 with cc = sc = 0, cs = c, ss = s
  assert(math.abs(math.cos(contact)) < 1e-15)
  return 2 / c * (1 - b * a), 0 * s -- ∫k w = k/2 (A (sc + cs) + 2B ss) = P/2 in scaled pressures
end)()
local function hetenyi(x)
  local t <const> = contact - x
  return A * ch(t) * math.cos(t) + B * (ch(t) * math.sin(t) + sh(t) * math.cos(t))
end
