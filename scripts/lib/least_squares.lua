-- Least-squares lines, and what the scripts read off them. Loaded by include.

local fit = {}

-- Slope and intercept of the line y = slope·x + intercept that is nearest to the points (x[k], y[k]) in the
-- sum of squares of y.
function fit.line(x, y)
  local n, sx, sy, sxx, sxy = #x, 0, 0, 0, 0
  for k = 1, n do sx, sy, sxx, sxy = sx + x[k], sy + y[k], sxx + x[k]^2, sxy + x[k] * y[k] end
  local slope = (n * sxy - sx * sy) / (n * sxx - sx^2)
  return slope, (sy - slope * sx) / n
end

-- Where that line crosses zero.
function fit.zero(x, y)
  local slope, intercept = fit.line(x, y)
  return -intercept / slope
end

-- Observed order of convergence: the exponent of error ~ h^order, from the line through the logarithms.
function fit.order(h, error)
  local x, y = {}, {}
  for k = 1, #h do x[k], y[k] = math.log(h[k]), math.log(error[k]) end
  return (fit.line(x, y))
end

return fit
