#pragma once
// Which known name did the user mean? One rule for keys, methods, choices,
// parts, globals and fields.
#include <string>
#include <string_view>
#include <vector>

namespace dotyk::script {

// The number of single-letter slips (insert, drop, replace, swap neighbours)
// that turn one name into the other; letters differing in case only are equal.
int edit_distance(std::string_view a, std::string_view b);

// The candidate a person is most likely to have meant, or an empty string. Near
// means: at most one slip for every three letters, or one name (of two letters
// or more) begins the other.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

// "a, b or c", each between the given quotes.
std::string join(const std::vector<std::string>& names, std::string_view last = "or",
                 std::string_view quote = "'");

// "unknown key 'fricton', did you mean 'friction'?", or, when nothing is near,
// "unknown key 'foo', expected 'a', 'b' or 'c'". `what` is "key", "method", …
std::string unknown_name(std::string_view what, std::string_view name,
                         const std::vector<std::string>& candidates);

}  // namespace dotyk::script
