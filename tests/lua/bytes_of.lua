-- What a file holds.
return function(file)
  local f <const> = assert(io.open(file, "rb"))
  local all <const> = f:read "a"
  f:close()
  return all
end
