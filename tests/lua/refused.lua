-- What a script must not do is an error at its own line, and nothing is lost by it.
--
--   local refused <const> = require "refused"
--   refused.intact = function() … end      -- called after each refusal; asserts that all is as it was
--   refused(function() dotyk.material{ E = 0 } end, "E is 0", "must be positive")
--
-- fn raises an error that begins with the file and a line of fn (the very line where fn is written on
-- one) and contains every text. Returns the message.
local refused <const> = setmetatable({}, {
  __call = function(self, fn, ...)
    local ok, message = pcall(fn)
    if ok then error("expected an error, got none", 2) end
    message = tostring(message)
    local info = debug.getinfo(fn, "S")
    local file, line = message:match "^([^:\n]+):(%d+): "
    line = tonumber(line)
    if file ~= info.short_src or not line or line < info.linedefined or line > info.lastlinedefined then
      error(("expected an error at %s:%d, got %q"):format(info.short_src, info.linedefined, message), 2)
    end
    for _, text in ipairs{ ... } do
      if not message:find(text, 1, true) then error(("expected %q in the error %q"):format(text, message), 2) end
    end
    if self.intact then self.intact() end
    return message
  end,
})

-- A pressed block on a rigid floor whose solution is known, for `intact`: solve() asserts that it has it still.
function refused.pressed_block()
  local check <const> = require "check"
  local it = { material = dotyk.material{ E = 10, nu = 0 },
               mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} } }
  it.body = dotyk.body{ name = "block", mesh = it.mesh, material = it.material }
  it.top, it.bottom, it.left, it.right = it.body:part "top", it.body:part "bottom", it.body:part "left", it.body:part "right"
  it.top:load{ 0, -1 }
  it.left:fix "x"
  it.scene = dotyk.scene{ it.body }
  it.floor = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }
  it.contact = it.scene:contact{ it.bottom, rigid = it.floor }
  function it.solve()
    local s = dotyk.solve(it.scene)
    check.that(s.converged)
    check.near(s.energy, -0.05)
    check.near(s:contact(it.contact).force, { 0, 1 })
    return s
  end
  return it
end

return refused
