-- Random choices for scripts/studies/random_scenes.lua, the same for the same seed. Loaded by include.

local dice = {}

function dice.roll(seed) math.randomseed(seed) end

-- Three digits are enough for a description, and can be read and typed.
local function short(v) return tonumber(("%.3g"):format(v)) end

function dice.chance(probability) return math.random() < probability end
function dice.between(from, to) return short(from + (to - from) * math.random()) end
function dice.power(from, to) return short(10 ^ (from + (to - from) * math.random())) end
function dice.whole(from, to) return math.random(from, to) end
function dice.sign() return math.random() < 0.5 and -1 or 1 end
function dice.pick(list) return list[math.random(#list)] end

-- One of the names in { "name", weight, "name", weight, … }.
function dice.weighted(list)
  local sum = 0
  for k = 2, #list, 2 do sum = sum + list[k] end
  local at = sum * math.random()
  for k = 2, #list, 2 do
    at = at - list[k]
    if at < 0 then return list[k - 1] end
  end
  return list[#list - 1]
end

return dice
