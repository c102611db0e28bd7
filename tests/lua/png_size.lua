-- Width and height of a PNG file, in pixels.
return function(file)
  local f <const> = assert(io.open(file, "rb"))
  local head <const> = f:read(24)
  f:close()
  local width <const>, height <const> = string.unpack(">I4I4", head, 17)
  return { width, height }
end
