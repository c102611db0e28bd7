-- What dotyk.work_precision says: the table, the file of comma-separated values, the figure.
local core <const> = ...
local rows <const> = core.load "work_precision_rows"

local report = {}

local described <const> = { energy = "relative error, energy norm", displacement = "relative error, displacement in L2",
  pressure = "relative error, contact pressure in L2", peak_pressure = "relative error, peak pressure" }

local function number(value, format) return value and format:format(value) or "–" end

-- Texts padded by letters, not bytes.
local function left(text, width) return text .. (" "):rep(width - utf8.len(text)) end
local function right(text, width) return (" "):rep(width - utf8.len(text)) .. text end

-- A text of one line, cut after so many letters.
local function short(text, letters)
  text = text:gsub("%s+", " ")
  if utf8.len(text) <= letters then return text end
  return text:sub(1, utf8.offset(text, letters) - 1) .. "…"
end

local columns <const> = {
  { "level", function(r) return tostring(r.level) end },
  { "tol", function(r) return number(r.tol, "%.0e") end },
  { "unknowns", function(r) return number(r.unknowns, "%d") end },
  { "iterations", function(r) return number(r.iterations, "%d") end },
  { "error", function(r) return number(r.error, "%.3e") end },
  { "seconds", function(r) return number(r.seconds, "%.4f") end },
  { "least", function(r) return number(r.low, "%.4f") end },
  { "most", function(r) return number(r.high, "%.4f") end },
  { "assembly", function(r) return number(r.assembly, "%.4f") end },
  { "motions", function(r) return number(r.motions, "%.4f") end },
  { "factor", function(r) return number(r.factor and r.factor + r.ordering, "%.4f") end },
  { "iterate", function(r) return number(r.iterate, "%.4f") end },
  { "recover", function(r) return number(r.recover, "%.4f") end },
}

local function remark(row)
  if row.status == "converged" then return row.front and "  *" or "" end
  return ("  %s: %s"):format(row.status, short(row.reason, 90))
end

-- "pdas on levels 1, 2, 3; newton on level 4": the rows, by method.
local function listed(some, tolerances)
  local texts <const> = {}
  for k, group in ipairs(rows.groups(some, "method")) do
    local levels <const> = {}
    for i, row in ipairs(group) do levels[i] = tolerances and ("%d (tol %.0e)"):format(row.level, row.tol) or tostring(row.level) end
    texts[k] = ("%s on level%s %s"):format(group[1].method, #levels > 1 and "s" or "", table.concat(levels, ", "))
  end
  return table.concat(texts, "; ")
end

-- "on level 4 pdas is fastest; times as long: newton 1.5, …", by rows converged to the least of the tolerances; nil where
-- fewer than two are.
function report.verdict(all, tolerances)
  local last <const>, tol <const> = all[#all].level, tolerances and math.min(table.unpack(tolerances))
  local best, by = {}, {}
  for _, row in ipairs(all) do
    if row.level == last and row.status == "converged" and (not tol or row.tol == tol) then
      best[#best + 1], by[row.method] = row.method, row.seconds
    end
  end
  if #best < 2 then return nil end
  table.sort(best, function(a, b) return by[a] < by[b] end)
  local texts <const> = {}
  for k = 2, #best do texts[#texts + 1] = ("%s %.3g"):format(best[k], by[best[k]] / by[best[1]]) end
  return ("on level %d%s %s is fastest; times as long: %s"):format(last, tol and (" to tol %.0e"):format(tol) or "", best[1],
    table.concat(texts, ", "))
end

function report.print(all, options, reference)
  local widest, widths = 6, {}
  for _, row in ipairs(all) do widest = math.max(widest, utf8.len(row.method)) end
  local header = left("method", widest)
  for k, column in ipairs(columns) do
    widths[k] = #column[1]
    for _, row in ipairs(all) do widths[k] = math.max(widths[k], utf8.len(column[2](row))) end
    header = header .. "  " .. right(column[1], widths[k])
  end
  print(header)
  for _, row in ipairs(all) do
    local line = left(row.method, widest)
    for k, column in ipairs(columns) do line = line .. "  " .. right(column[2](row), widths[k]) end
    print(line .. remark(row))
  end
  print(("error: %s%s; seconds: median of up to %d runs; *: the front"):format(options.label or described[options.error] or "the function's",
    reference.level and (" against level %d"):format(reference.level) or "", options.repeats))
  print("front: " .. listed(rows.front(all), options.tolerances))
  local verdict <const> = report.verdict(all, options.tolerances)
  if verdict then print(verdict) end
end

-- Comma-separated values.
local fields <const> = { "method", "tol", "level", "unknowns", "rows", "iterations", "status", "error", "seconds", "low", "high", "runs",
  "assembly", "motions", "ordering", "factor", "iterate", "recover", "front", "reason" }

local function cell(value)
  if value == nil then return "" end
  if math.type(value) == "float" then return ("%.10g"):format(value) end
  if type(value) ~= "string" then return tostring(value) end
  return value:find '[",\n]' and '"' .. value:gsub('"', '""') .. '"' or value
end

function report.csv(all)
  local lines <const> = { table.concat(fields, ",") }
  for _, row in ipairs(all) do
    local cells <const> = {}
    for k, field in ipairs(fields) do cells[k] = cell(row[field]) end
    lines[#lines + 1] = table.concat(cells, ",")
  end
  return table.concat(lines, "\n") .. "\n"
end

-- The least error that is had in so many seconds: a staircase down through the rows of the front, from the fastest on.
local function front_of(all)
  local out <const> = { name = "Pareto front", front = true, style = "line", x = {}, y = {} }
  for _, row in ipairs(rows.front(all)) do
    local k <const> = #out.x
    if k > 0 then out.x[k + 1], out.y[k + 1] = row.seconds, out.y[k] end
    out.x[#out.x + 1], out.y[#out.y + 1] = row.seconds, row.error
  end
  return out
end

local function series_of(name, some, extra)
  local out <const> = { name = name, x = {}, y = {}, x_low = {}, x_high = {} }
  for _, row in ipairs(some) do
    local k <const> = #out.x + 1
    out.x[k], out.y[k], out.x_low[k], out.x_high[k] = row.seconds, row.error, row.low, row.high
  end
  for key, value in pairs(extra or {}) do out[key] = value end
  return out
end

-- What the legend says of rows without a solution that counts: "not converged: level 3"; nil where there are none.
local function failure(some)
  local texts <const> = {}
  for _, group in ipairs(rows.groups(some, "status")) do
    local levels <const> = {}
    for _, row in ipairs(group) do
      if levels[#levels] ~= row.level then levels[#levels + 1] = row.level end
    end
    if group[1].status ~= "converged" then
      texts[#texts + 1] = ("%s on %s %s"):format(group[1].status, #levels > 1 and "levels" or "level", table.concat(levels, ", "))
    end
  end
  return #texts > 0 and table.concat(texts, ", ") or nil
end

-- Rows that count, those that failed with an error that can be measured, and without.
local function split(some)
  local good, poor, lost = {}, {}, {}
  for _, row in ipairs(some) do
    if row.error and row.seconds then
      local to <const> = row.status == "converged" and good or (row.error > 0 and row.error < math.huge) and poor or lost
      to[#to + 1] = row
    end
  end
  return good, poor, lost
end

-- The series of the chart: a curve of each method over the levels; with several tolerances over these, one for each level,
-- the later ones dashed.
function report.series(all, tolerances)
  local out <const> = { front_of(all) }
  for _, of_method in ipairs(rows.groups(all, "method")) do
    local method <const> = of_method[1].method
    for k, curve in ipairs((tolerances and #tolerances > 1) and rows.groups(of_method, "level") or { of_method }) do
      local good <const>, poor <const>, lost <const> = split(curve)
      local why <const> = k == 1 and failure(of_method)
      local named <const> = k == 1 and not (why and #good == 0)  -- not in the legend twice
      out[#out + 1] = series_of(named and method or nil, good, { twin = k > 1 or nil })
      if why or #poor > 0 then
        out[#out + 1] = series_of(why and ("%s: %s"):format(method, why) or nil, poor, { twin = true, crossed = true, style = "points" })
      end
      if #lost > 0 then
        local failed <const> = series_of(nil, lost, { twin = true, crossed = true, style = "points" })
        failed.y, failed.x_low, failed.x_high = nil, nil, nil
        out[#out + 1] = failed
      end
    end
  end
  return out
end

-- What would fail after all the runs is said before them.
function report.check(options) core.check_figure(options.file, options.title, options.label) end

function report.write(all, options)
  local csv = options.csv
  if csv == nil or csv == true then csv = options.file and options.file:gsub("%.%w+$", "") .. ".csv" end
  local written <const> = {}
  if options.file then
    dotyk.chart{ file = options.file, title = options.title, size = options.size, slopes = options.slopes, log = "xy",
      x = options.repeats > 1 and ("seconds (median of %d, whiskers: least and greatest)"):format(options.repeats) or "seconds",
      y = options.label or described[options.error] or "error", series = report.series(all, options.tolerances) }
    written[1] = options.file
  end
  if csv then
    core.write(csv, report.csv(all))
    written[#written + 1] = csv
  end
  if #written > 0 then print(table.concat(written, ", ")) end
end

return report
