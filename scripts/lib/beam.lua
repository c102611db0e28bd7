-- A continuous beam. Loaded by include; solves nothing itself.

-- Five supports of one law at 0, 1, … 4, a load on the second span. EJ: a number or a function.
return function(support, cells, EJ)
  local inner = {}
  for x = 1, 3 do inner[x] = { x = x, deflection = support } end
  return dotyk.beam{ length = 4, EJ = EJ or 1, cells = cells, left = { deflection = support }, right = { deflection = support },
    supports = inner, load = function(x) return (x > 1 and x < 2) and -10 or -0.2 end }
end
