-- The most memory that the process has had, in gigabytes, as Linux tells it.
return function()
  for line in io.lines "/proc/self/status" do
    local kilobytes <const> = line:match "VmHWM:%s*(%d+)"
    if kilobytes then return kilobytes / 1e6 end
  end
end
