-- What the paper takes from results/. Every number of ours in the text, the tables and the claims comes from here when the
-- PDF is built. What is missing, not unique or no longer true ends the build with one line.

local results = {}
local folder = os.getenv("MAXWRENCH_RESULTS")

local function fail(message)
  io.stderr:write("\npaper: " .. message .. "\n")
  os.exit(1)
end

-- The lines of results/FILE, or of results/FILE.gz, read once. LuaTeX's gzip reads both, whatever their names.
local files = {}
local function lines_of(file)
  if files[file] then return files[file] end
  local input = gzip.open(folder .. "/" .. file) or gzip.open(folder .. "/" .. file .. ".gz")
  if not input then fail("results/" .. file .. ": is missing") end
  local lines = {}
  for line in input:lines() do lines[#lines + 1] = line end
  input:close()
  files[file] = lines
  return lines
end

---------------------------------------------------------------- tables in text

-- Where `name` stands as a word of its own in `line`, the n-th time.
local function find_word(line, name, n)
  local from = 1
  while true do
    local first, last = line:find(name, from, true)
    if not first then return nil end
    local before, after = line:sub(first - 1, first - 1), line:sub(last + 1, last + 1)
    if (first == 1 or before == " ") and (after == "" or after == " ") then
      n = n - 1
      if n == 0 then return first, last end
    end
    from = first + 1
  end
end

-- The word of `line` that stands below the columns first to last, or next to them (heads do not always end where their cells do).
local function word_below(line, first, last)
  local found
  local from = 1
  while true do
    local a, b = line:find("%S+", from)
    if not a then return found end
    if a <= last + 1 and b >= first - 1 and line:sub(a, b) ~= "%" then
      if found then return nil end
      found = line:sub(a, b)
    end
    from = b + 1
  end
end

local function starts_with_words(line, words)
  local flat = line:gsub("%s+", " ") .. " "
  return flat:sub(1, #words + 1) == words .. " "
end

-- The cell of a table with right-aligned columns: the first row (not indented) below the line "SECTION:" that begins with the words ROW,
-- under the nearest head above it that has COLUMN ("tank@2": the second of that name).
function results.cell(file, section, row, column)
  local where = "results/" .. file .. ": " .. (section ~= "" and section .. ", " or "")
  local lines = lines_of(file)
  local name, n = column:match("^(.*)@(%d+)$")
  name, n = name or column, tonumber(n or 1)
  local begin = section == "" and 1 or nil
  for i, line in ipairs(lines) do
    if not begin and line:sub(1, #section + 1) == section .. ":" then begin = i end
    if begin and i > begin and line:find("^[%w_]+/[%w_]+:") then break end
    if begin and i > begin and starts_with_words(line, row) then
      for j = i - 1, begin, -1 do
        local first, last = find_word(lines[j], name, n)
        if first then
          local word = word_below(line, first, last)
          if not word then fail(where .. "row '" .. row .. "': no value in column '" .. column .. "'") end
          return word
        end
      end
      fail(where .. "no column '" .. column .. "'")
    end
  end
  fail(where .. (begin and "no row '" .. row .. "'" or "no such section"))
end

---------------------------------------------------------------- tables of commas

local function split(line)
  local fields = {}
  local rest = line .. ","
  while rest ~= "" do
    local field, tail = rest:match('^"(.-)",(.*)$')
    if not field then field, tail = rest:match("^([^,]*),(.*)$") end
    fields[#fields + 1] = field
    rest = tail
  end
  return fields
end

local tables = {}
local function table_of(file)
  if tables[file] then return tables[file] end
  local lines = lines_of(file)
  local heads, rows = split(lines[1]), {}
  for i = 2, #lines do
    local row = {}
    for j, field in ipairs(split(lines[i])) do row[heads[j]] = field end
    rows[#rows + 1] = row
  end
  tables[file] = {heads = heads, rows = rows}
  return tables[file]
end

local function has_column(file, name)
  for _, head in ipairs(table_of(file).heads) do
    if head == name then return true end
  end
  return false
end

-- All rows with the values of SELECTOR ("problem=planar/force solver=facets"), at least one.
local function rows_of(file, selector)
  local wanted = {}
  for key, value in selector:gmatch("(%S+)=(%S*)") do
    if not has_column(file, key) then fail("results/" .. file .. ": no column '" .. key .. "'") end
    wanted[key] = value
  end
  local found = {}
  for _, row in ipairs(table_of(file).rows) do
    local all = true
    for key, value in pairs(wanted) do all = all and row[key] == value end
    if all then found[#found + 1] = row end
  end
  if #found == 0 then fail("results/" .. file .. ": no row with " .. selector) end
  return found
end

-- A column of the only row with the values of SELECTOR; "h:2": the second number of column h.
function results.csv(file, selector, column)
  local name, n = column:match("^(.*):(%d+)$")
  name = name or column
  if not has_column(file, name) then fail("results/" .. file .. ": no column '" .. name .. "'") end
  local rows = rows_of(file, selector)
  if #rows > 1 then fail("results/" .. file .. ": " .. #rows .. " rows with " .. selector) end
  local value = rows[1][name]
  if n then
    local k = 0
    for word in value:gmatch("%S+") do
      k = k + 1
      if k == tonumber(n) then return word end
    end
    value = ""
  end
  if value == "" then fail("results/" .. file .. ": no value in column '" .. column .. "' of " .. selector) end
  return value
end

---------------------------------------------------------------- what the text asks for

local function number(value, what)
  local x = tonumber((tostring(value):gsub("^%+", "")))
  if not x then fail(what .. ": '" .. tostring(value) .. "' is no number") end
  return x
end

local function show(value)
  return (value:gsub("^%-$", "--"):gsub("^%-(%d)", "$-$%1"):gsub("_", "\\_"))
end

function results.print_cell(...) tex.sprint(show(results.cell(...))) end

function results.print_csv(digits, ...)
  tex.sprint(show(string.format("%." .. digits .. "f", number(results.csv(...), "results/" .. (...)))))
end

-- What stands behind KEY in a file of lines "KEY VALUE".
function results.print_line(file, key)
  for _, line in ipairs(lines_of(file)) do
    if line:sub(1, #key + 1) == key .. " " then return tex.sprint((line:sub(#key + 2):gsub("%(R%)", ""))) end
  end
  fail("results/" .. file .. ": no line '" .. key .. "'")
end

-- What the claims are written in: numbers of cells, of rows, of races.
local claims = setmetatable({
  cell = function(...) return number(results.cell(...), "results/" .. (...)) end,
  csv = function(...) return number(results.csv(...), "results/" .. (...)) end,
  word = results.cell,
}, {__index = math})

-- TeX takes what is behind a bare % for a comment.
local function code_of(expression) return (expression:gsub("\\%%", "%%")) end

-- A sentence of the text rests on `claim`, an expression in Lua.
function results.holds(claim)
  claim = code_of(claim)
  local check = load("return " .. claim, claim, "t", claims)
  if not check then fail("the claim is not understood: " .. claim) end
  if not check() then fail("a sentence of the text is no longer true: " .. claim) end
end

-- The value of an expression in Lua, with so many digits behind the point.
function results.print_value(digits, expression)
  local value = load("return " .. code_of(expression), expression, "t", claims)()
  tex.sprint(show(string.format("%." .. digits .. "f", value)))
end

---------------------------------------------------------------- the race

local function code(name) return "\\texttt{" .. name:gsub("_", "\\_") .. "}" end

local static_race = "search_comparison.txt"

-- The rows of the last table of a race, each a list of cells. file: nil is the race on static tasks.
local function race_rows(file)
  local rows, heads = {}, nil
  for _, line in ipairs(lines_of(file or static_race)) do
    if line:sub(1, 1) == "|" then
      local cells = {}
      for cell in line:gmatch("|%s*([^|]-)%s*%f[|]") do cells[#cells + 1] = cell end
      if cells[1] == "search" then
        heads, rows = cells, {}
      elseif heads and not line:find("^|%-") then
        rows[#rows + 1] = cells
      end
    end
  end
  if not heads or #heads < 8 then fail("results/" .. (file or static_race) .. ": no table of all searches") end
  return heads, rows
end

-- Without a file, all searches of the race on static tasks; else those of that race of whose runs the given share [%] comes within 10 %.
function results.race_table(file, share)
  local heads, all = race_rows(file)
  local rows = {}
  for _, cells in ipairs(all) do
    if not file or tonumber(cells[4]) >= share then rows[#rows + 1] = cells end
  end
  tex.sprint("\\begin{tabular}{@{}l*{" .. #heads - 1 .. "}{r}@{}}\\toprule")
  local head = {"search"}
  for i = 2, #heads do
    local first, second = heads[i]:gsub("%%", "\\,\\%%"):match("^([^/]*)/?(.*)$")
    second = second:gsub("_any_height", "\\_free"):gsub("_", "\\_"):gsub("\\\\", "\\")
    head[i] = "\\shortstack[r]{" .. first:gsub("_", "\\_") .. (second ~= "" and "\\\\" .. second or "") .. "}"
  end
  tex.sprint(table.concat(head, " & ") .. "\\\\\\midrule")
  for _, cells in ipairs(rows) do
    local bold = cells[1]:find("**", 1, true)
    cells[1] = code((cells[1]:gsub("[*`]", "")))
    if bold then cells[1] = "\\textbf{" .. cells[1] .. "}" end
    for i = 2, #cells do
      if cells[i] == "-" then cells[i] = "--" end
    end
    tex.sprint(table.concat(cells, " & ") .. "\\\\")
  end
  tex.sprint("\\bottomrule\\end{tabular}")
end

-- A column of the table of all searches of a race.
function claims.race(search, column, file)
  local heads, rows = race_rows(file)
  for _, cells in ipairs(rows) do
    if cells[1]:gsub("[*`]", "") == search then
      for i, head in ipairs(heads) do
        if head == column then return tonumber(cells[i]) or math.huge end
      end
      fail("results/" .. (file or static_race) .. ": no column '" .. column .. "'")
    end
  end
  fail("results/" .. (file or static_race) .. ": no search '" .. search .. "'")
end

function claims.searches(file)
  local _, rows = race_rows(file)
  return #rows
end

function claims.seeds()
  local seeds = {}
  for _, row in ipairs(table_of("search_comparison.csv").rows) do seeds[row.seed] = true end
  local n = 0
  for _ in pairs(seeds) do n = n + 1 end
  return n
end

-- How many lines of a file have the words.
function claims.lines(file, words)
  local n = 0
  for _, line in ipairs(lines_of(file)) do
    if line:find(words, 1, true) then n = n + 1 end
  end
  return n
end

-- How many searches of the table satisfy the test.
function claims.count(test, file)
  local _, rows = race_rows(file)
  local n = 0
  for _, cells in ipairs(rows) do
    if test(cells[1]:gsub("[*`]", "")) then n = n + 1 end
  end
  return n
end

-- The static tasks of the race, in order.
local function problems()
  local names, seen = {}, {}
  for _, row in ipairs(table_of("search_comparison.csv").rows) do
    if row.scheme == "" and not seen[row.problem] then
      seen[row.problem] = true
      names[#names + 1] = row.problem
    end
  end
  return names
end

function claims.problems() return #problems() end

local function median(values)
  table.sort(values)
  local n = #values
  return n % 2 == 1 and values[(n + 1) / 2] or (values[n / 2] + values[n / 2 + 1]) / 2
end

-- Microseconds of the processor for one evaluation of a search by annealing, the median over its seeds, and by which solver.
local function microseconds(problem, search, lp)
  local selector = "problem=" .. problem .. " search=" .. search .. (lp and " solver=" .. lp or "")
  local evaluations, times, solver = {}, {}, nil
  for _, row in ipairs(rows_of("search_comparison.csv", selector)) do evaluations[row.seed] = row.evaluations end
  for _, row in ipairs(rows_of("search_times.csv", selector)) do
    local n = evaluations[row.seed]
    if not n then fail("results/search_comparison.csv: no row with " .. selector .. " seed=" .. row.seed) end
    times[#times + 1] = 1e6 * number(row.seconds, "results/search_times.csv") / number(n, "evaluations")
    solver = row.solver
  end
  return median(times), solver
end

local function three_digits(x)
  return string.format(x >= 99.95 and "%.0f" or x >= 9.995 and "%.1f" or "%.2f", x)
end

-- Each task of the race: its best value, whether it is proven, and what one evaluation takes through three solvers.
function results.task_rows(coordinates)
  for _, problem in ipairs(problems()) do
    if not coordinates[problem] then fail("the text does not say the coordinates of " .. problem) end
    local row = rows_of("search_comparison.csv", "problem=" .. problem)[1]
    local ours, solver = microseconds(problem, "annealing")
    local glpk = microseconds(problem, "annealing+cmaes", "glpk")
    local clp = microseconds(problem, "annealing+cmaes", "clp")
    tex.sprint(table.concat({code(problem), coordinates[problem],
                             string.format("%.2f", number(row.best_known, "best known")) .. "\\," .. row.unit:gsub(" ", "\\,"),
                             row.proven == "yes" and "yes" or "--", code(solver), three_digits(ours), three_digits(glpk),
                             three_digits(clp), three_digits(math.min(glpk, clp) / ours)}, " & ") .. "\\\\")
  end
end

-- The least and the largest of min(GLPK, Clp) over ours, of all problems.
function claims.speedup(which)
  local all = {}
  for _, problem in ipairs(problems()) do
    local ours = microseconds(problem, "annealing")
    all[#all + 1] = math.min(microseconds(problem, "annealing+cmaes", "glpk"),
                             (microseconds(problem, "annealing+cmaes", "clp"))) / ours
  end
  return which == "median" and median(all) or math[which](table.unpack(all))
end

function claims.proven()
  local n = 0
  for _, problem in ipairs(problems()) do
    if rows_of("search_comparison.csv", "problem=" .. problem)[1].proven == "yes" then n = n + 1 end
  end
  return n
end

-- The sum of a column.
function claims.total(file, column)
  local sum = 0
  for _, row in ipairs(rows_of(file, "")) do sum = sum + number(row[column] or "", "results/" .. file .. ": " .. column) end
  return sum
end

-- A column of one solver in a benchmark set of the report.
function claims.solver(benchmark_set, lp, column)
  for _, row in ipairs(rows_of("report/solvers.csv", "solver=" .. lp)) do
    if row.benchmark_set == benchmark_set then return number(row[column], "results/report/solvers.csv: " .. column) end
  end
  fail("results/report/solvers.csv: no " .. lp .. " in '" .. benchmark_set .. "'")
end

-- A column of one integrator of the virtual tank.
function claims.integrator(name, column)
  local row = rows_of("report/integrators.csv", "integrator=" .. name)[1]
  return number(row[column], "results/report/integrators.csv: " .. column)
end

-- By how much the readings of one experiment differ at most between integrators [%].
function claims.readings_apart()
  local least, most, apart = {}, {}, 0
  for _, row in ipairs(rows_of("report/experiments.csv", "")) do
    local reading = tonumber(row.reading)
    if reading then
      local key = table.concat({row.problem, row.wrench, row.solver, row.scheme}, " ")
      least[key] = math.min(least[key] or reading, reading)
      most[key] = math.max(most[key] or reading, reading)
      local size = math.max(math.abs(most[key]), math.abs(least[key]))
      apart = math.max(apart, 100 * (most[key] - least[key]) / size)
    end
  end
  return apart
end

-- The solvers of a benchmark set of the report, best first.
function results.solver_rows(benchmark_set)
  local found = false
  for _, row in ipairs(table_of("report/solvers.csv").rows) do
    if row.benchmark_set == benchmark_set then
      found = true
      local function digits(column)
        return row[column] == "" and "--" or three_digits(number(row[column], "results/report/solvers.csv: " .. column))
      end
      local times = row.times_low == "" and digits("times")
                    or digits("times") .. " [" .. digits("times_low") .. ", " .. digits("times_high") .. "]"
      tex.sprint(table.concat({code(row.solver), row.solved, row.instances, digits("us"),
                               string.format("%.0f", 100 * tonumber(row.share_double)), times}, " & ") .. "\\\\")
    end
  end
  if not found then fail("results/report/solvers.csv: no benchmark set '" .. benchmark_set .. "'") end
end

return results
