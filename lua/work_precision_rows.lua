-- Rows of dotyk.work_precision and what is computed of rows alone: names, medians, the Pareto front.
local rows = {}

-- Parts of "solver uzawa: rho = 0.9, tol = 1e-10, …".
local function parts_of(text)
  local name <const> = text:match "^solver ([^:,]+)" or text
  local options <const> = {}
  for option in (text:match "^[^:]*:(.*)$" or ""):gmatch "[^,]+" do
    options[#options + 1] = option:match "^%s*(.-)%s*$"
  end
  return name, options
end

-- Short names of methods, from their texts: the method's, with the options that tell it from others of its kind; the k-th
-- is texts[k].name where that is a table. Names met twice are numbered.
function rows.names(texts)
  local kinds, uses, out, seen = {}, {}, {}, {}
  for k, text in ipairs(texts) do
    if type(text) == "string" then
      local name <const>, options <const> = parts_of(text)
      kinds[k] = { name = name, options = options }
      uses[name] = uses[name] or { count = 0, of = {} }
      uses[name].count = uses[name].count + 1
      for _, option in ipairs(options) do uses[name].of[option] = (uses[name].of[option] or 0) + 1 end
    end
  end
  for k, text in ipairs(texts) do
    local kind <const> = kinds[k]
    local name = kind and kind.name or text.name
    for _, option in ipairs(kind and kind.options or {}) do
      local use <const> = uses[kind.name]
      if use.of[option] < use.count then name = name .. ", " .. option:gsub("^(%S+) = ", "%1 ") end
    end
    seen[name] = (seen[name] or 0) + 1
    out[k] = seen[name] == 1 and name or ("%s (%d)"):format(name, seen[name])
  end
  return out
end

-- The run whose seconds are the median (the lower of two), the least and the greatest seconds.
function rows.median(runs)
  local sorted <const> = table.move(runs, 1, #runs, 1, {})
  table.sort(sorted, function(a, b) return a.seconds < b.seconds end)
  return sorted[(#sorted + 1) // 2], sorted[1].seconds, sorted[#sorted].seconds
end

-- The row of a runner's runs on a level; status "converged", "not converged", "refused", "stopped" (by the budget) or "not run".
function rows.row(runner, level)
  local row <const> = { method = runner.method, tol = runner.tol, level = level, front = false, runs = #runner.runs }
  local s <const> = runner.last
  if runner.over then
    row.status, row.reason = "not run", runner.over
  elseif runner.stopped and not (s and s.converged) then
    row.status, row.reason = "stopped", runner.why
  elseif not s then
    row.status, row.reason = "refused", runner.why
  else
    row.status, row.reason = s.converged and "converged" or "not converged", s.reason
  end
  if s then
    row.iterations = s.iterations
    local middle
    middle, row.low, row.high = rows.median(runner.runs)
    row.seconds = middle.seconds
    for _, part in ipairs{ "assembly", "motions", "ordering", "factor", "iterate", "recover" } do
      row[part] = middle.time[part]
    end
  end
  return row
end

-- The rows in groups that have one value of a field, each group where its first row was.
function rows.groups(some, field)
  local out <const>, of <const> = {}, {}
  for _, row in ipairs(some) do
    local value <const> = row[field]
    if not of[value] then of[value] = {}; out[#out + 1] = of[value] end
    table.insert(of[value], row)
  end
  return out
end

local function counts(row) return row.status == "converged" and row.error and row.seconds end

-- Errors that differ by less are equal: what tol leaves, not accuracy.
local equal <const> = 0.01

-- The rows that no other one beats, by seconds: each is nearer than all that are as fast.
function rows.front(all)
  local sorted, out = {}, {}
  for _, row in ipairs(all) do if counts(row) then sorted[#sorted + 1] = row end end
  table.sort(sorted, function(a, b)
    if a.seconds ~= b.seconds then return a.seconds < b.seconds end
    return a.error < b.error
  end)
  for _, row in ipairs(sorted) do
    local last <const> = out[#out]
    if not last or row.error < (1 - equal) * last.error then out[#out + 1] = row end
  end
  return out
end

function rows.mark_front(all)
  for _, row in ipairs(rows.front(all)) do row.front = true end
end

return rows
