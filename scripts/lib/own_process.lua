-- Runs a script in a process of its own, and returns the table that this process prints as a Lua chunk, return {…}. Loaded by include.

local program <const> = io.popen("readlink /proc/$PPID/exe"):read "l"

-- The words after `script` are its arguments.
return function(script, ...)
  local pipe <close> = io.popen(("OPENBLAS_NUM_THREADS=1 '%s' '%s' %s 2>&1"):format(program, script, table.concat({ ... }, " ")))
  local told <const> = pipe:read "a"
  return load(told:match "return {.*}" or error(script .. ": " .. told, 0))()
end
