#!/bin/bash
# What the launcher promises beyond building: found through a symbolic link and
# from another folder, no build when nothing changed, one build at a time. A copy
# of it runs here on a small project of its own.
. "$(dirname "$0")/scratch.sh"
unset DOTYK_BUILD

project=$folder/project
mkdir -p "$project/src/script" "$folder/elsewhere"
cp "$dotyk" "$project/dotyk"
cat >"$project/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES CXX)
add_subdirectory(src/script)
CMAKE
echo 'add_executable(dotyk main.cpp)' >"$project/src/script/CMakeLists.txt"
program() {
  printf '#include <cstdio>\n#include <unistd.h>\nint main(int n, char** a) { char d[999]; std::printf("%%s %s %%d %%s\\n", getcwd(d, 999), n, a[n - 1]); return 3; }\n' "$1" \
    >"$project/src/script/main.cpp"
}
program one
ln -s ../project/dotyk "$folder/elsewhere/link"
cd "$folder/elsewhere" || exit 1

# Two at the same time: one of them builds.
./link a >out1.txt 2>err1.txt & first=$!
./link b >out2.txt 2>err2.txt & second=$!
wait $first; [[ $? == 3 ]] || fail "exit status of the program"
wait $second; [[ $? == 3 ]] || fail "exit status of the second"
[[ $(<out1.txt) == "$folder/elsewhere one 2 a" ]] || fail "output: $(<out1.txt) $(<err1.txt)"
[[ $(<out2.txt) == "$folder/elsewhere one 2 b" ]] || fail "output: $(<out2.txt) $(<err2.txt)"
[[ $(cat err1.txt err2.txt | grep -c '^dotyk: building') == 1 ]] || fail "both built, or none"

# Nothing changed: cmake is not started, and all is silent.
mkdir "$folder/watched"
printf '#!/bin/sh\ntouch "%s"\nexit 1\n' "$folder/started" >"$folder/watched/cmake"
chmod +x "$folder/watched/cmake"
PATH=$folder/watched:$PATH ./link c >out.txt 2>err.txt
[[ $? == 3 && ! -s err.txt && ! -e $folder/started ]] || fail "a start without changes: $(<err.txt)"

# A changed source is built again; a broken one is exit status 2, and repaired next time.
sleep 1
program two
[[ $(./link d 2>/dev/null) == "$folder/elsewhere two 2 d" ]] || fail "no new build"
sleep 1
echo 'broken' >"$project/src/script/main.cpp"
./link e >out.txt 2>/dev/null
[[ $? == 2 && ! -s out.txt ]] || fail "a failed build"
program three
[[ $(./link f 2>/dev/null) == "$folder/elsewhere three 2 f" ]] || fail "no build after a failed one"

exit $((failures > 0))
