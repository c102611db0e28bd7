#include "values.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::fuzz {
namespace {

using script::Key;
using script::Kind;

// What keys of the kind string are about: parts, names, fields.
const std::vector<std::string> words = {"left", "right", "bottom", "top", "front", "back", "boundary", "inner", "outer", "x", "y", "xy", "a"};

const std::vector<std::string> functions = {
    "function(x, y, z) return 0.1 end",
    "function(x, y, z) return (x or 0) * 0.5 end",
    "function(x, y, z) return x, y, z end",
    "function(x, y, z) return { x, y, z } end",
    "function(x, y) return { 0, -0.1 } end",
    "function(x, y, z) return x > 0.3 end",
    "function(x, y, nx, ny) return ny and ny > 0.5 end",
    "function() return true end",
    "function() return false end",
    "function() end",
    "function() return 0/0 end",
    "function() return 1/0 end",
    "function() return 'text' end",
    "function() return {} end",
    "function(a) return a end",
    "function() error 'no' end",
    "function(x) return 1e300 * (x or 1) end",
    "function(x) return x.y.z end"};

// What a function may do beside giving a value: see prelude.lua.
const std::vector<std::string> odd_functions = {
    "function() raise 'no' end",
    "function() raise 'two\\nlines' end",
    "function() raise{} end",
    "function() raise(nil) end",
    "function() raise(3) end",
    "function() raise(print) end",
    "function() raise(setmetatable({}, { __tostring = function() error 'none' end })) end",
    "function(...) raise(V[1]) end",
    "function(...) return coroutine.yield(...) end",
    "coroutine.wrap(function(...) local x = ... while true do x = coroutine.yield(x) end end)",
    "coroutine.wrap(function(...) return ... end)",
    "function(...) return odd.inside(function(...) coroutine.yield() return ... end, ...) end",
    "function(...) local _ <close> = odd.closing() return ... end",
    "function(...) local _ <close> = odd.closing() raise{} end",
    "function(x) local _ <close> = odd.closing() return 0.1 * (x or 1) end",
    "function(...) collectgarbage() return ... end",
    "function(x) collectgarbage 'step' return 0.5 end",
    "function(...) odd.litter() return ... end",
    "function(x) odd.litter() return 0.1 end",
    "function(...) odd.sweep() return ... end",
    "function(x) odd.sweep() return 0.1 end",
    "function() odd.sweep() end",
    "function(x, y, z) odd.close_chain(20) return x, y, z end",
    "function(x) odd.close_chain(150, true) return -0.1 end",
    "function(...) odd.again(2, ...) return ... end",
    "function(x) odd.again(2, x) return 0.2 end",
    "function() odd.again(3) end",
    "function(...) odd.touch(...) return ... end",
    "function(x) odd.touch(x) return 0.3 end",
    "function() odd.touch() end",
    "function(...) V = {} collectgarbage() return ... end",
    "setmetatable({}, { __call = function(_, x) return x end })",
    "string.rep",
    "math.floor",
    "setmetatable",
    "next",
    "pcall",
    "raise"};

// Objects that need no others.
const std::map<std::string, std::vector<std::string>> makers = {
    {"law", {"dotyk.law.signorini()", "dotyk.law.elastic(2)", "dotyk.law.prescribed(0)", "dotyk.law.friction(0.5)", "dotyk.law.free()",
             "dotyk.law.one_sided_friction(1)", "dotyk.law.breaking{ k = 1, g = 1 }", "dotyk.law.capped_elastic{ k = 1, g = 1 }"}},
    {"solver", {"dotyk.solver.pdas{}", "dotyk.solver.newton{}", "dotyk.solver.uzawa{}", "dotyk.solver.uzawa_pdas{}", "dotyk.solver.psor{}",
                "dotyk.solver.projected_cg{}", "dotyk.solver.proximal{}", "dotyk.solver.coulomb_loop{}", "dotyk.solver.feti{ subdomains = 2 }",
                "dotyk.solver.active_set{}", "dotyk.solver.interior_point{}", "dotyk.solver.penalty{}"}},
    {"friction", {"dotyk.friction.coulomb(0.3)", "dotyk.friction.tresca(0.1)"}},
    {"rigid", {"dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }", "dotyk.rigid.ball{ center = {0.5,-1}, radius = 1 }",
               "dotyk.rigid.gap{ normal = {0,1}, gap = function(x) return x^2 end }"}},
    {"material", {"dotyk.material{ E = 10, nu = 0.25 }", "dotyk.material{ E = function(x) return 1 + x^2 end, nu = 0.3 }"}},
    {"mesh", {"dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} }", "dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {1,2,1} }",
              "dotyk.mesh.disc{ center = {0,0}, radius = 1, cells = 3 }", "dotyk.mesh.disc{ center = {0,0}, radius = 1, cells = 2, element = 'P2' }",
              "dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {1,1,2}, element = 'Q2' }"}}};

const std::vector<std::string> wrongs = {
    "nil", "true", "0/0", "1/0", "-1/0", "1e308", "-1e308", "5e-324", "-0.0", "1 << 62", "math.mininteger", "0.5", "''", "'text'",
    "('x'):rep(1000)", "'a\\0b'", "'\\xff%s'", "{}", "{{}}", "{{{1}}}", "{ 0/0 }", "{ [2] = 1 }", "{ x = 1 }", "{ 1, 'a' }", "{ 1, nil, 3 }",
    "function() end", "print", "io.stdout", "coroutine.create(print)", "setmetatable({}, { __index = function() return 1 end })",
    "{ {1,2}, {3} }", "-1", "0", "1e9", "{ 1e9, 1e9 }", "{ 1e9, 1e9, 1e9 }", "{ 0, 0 }", "dotyk"};

}  // namespace

std::string Values::value(const Key& key) { return once_in(30) ? wrong() : fitting(key); }

std::string Values::wrong() {
  if (!pool_.empty() && once_in(4)) {
    auto some = pool_.begin();
    std::advance(some, below(static_cast<int>(pool_.size())));
    return of(some->second);
  }
  return of(wrongs);
}

std::string Values::fitting(const Key& key) {
  switch (key.kind) {
    case Kind::number:
      return number(key);
    case Kind::integer:
      return integer(key);
    case Kind::boolean:
      return once_in(2) ? "true" : "false";
    case Kind::string:
      return "'" + of(words) + "'";
    case Kind::file:
      return file(key);
    case Kind::choice:
      return "'" + of(key.choices) + "'";
    case Kind::vector:
      return list(key, 2 + static_cast<std::size_t>(below(3)), nullptr);
    case Kind::matrix: {
      const int size = 1 + below(3);
      std::string rows;
      for (int i = 0; i < size; ++i) {
        rows += "{";
        for (int j = 0; j < size; ++j) rows += (i == j ? "2" : number(Key{})) + ", ";
        rows += "}, ";
      }
      return "{ " + rows + "}";
    }
    case Kind::field:
      return once_in(3) ? function() : once_in(2) ? number(key) : list(Key{}, 2 + static_cast<std::size_t>(below(2)), nullptr);
    case Kind::function:
      return function();
    case Kind::object:
      return object(key.type);
    case Kind::list:
      return list(key, 1 + static_cast<std::size_t>(below(3)), &key.items.front());
    case Kind::table:
      return table(key);
    case Kind::either:
      return value(key.keys[static_cast<std::size_t>(below(static_cast<int>(key.keys.size())))]);
    case Kind::any:
      return wrong();
  }
  return "nil";
}

std::string Values::number(const Key& key) {
  static const std::vector<std::string> usual = {"0", "1", "-1", "0.3", "0.5", "2", "10", "1e-3", "-0.1", "1e-10", "1000", "0.25", "1/3"};
  if (key.units == "time") return of({"0.1", "1", "2"});  // steps up to it, which may be short
  const bool low = std::isfinite(key.least), high = std::isfinite(key.greatest);
  if (once_in(8) && low) return script::number_text(key.least);
  if (once_in(8) && high) return script::number_text(key.greatest);
  if (low && high) return script::number_text(key.least + (key.greatest - key.least) * std::uniform_real_distribution<>(0, 1)(random_));
  if (!low && !high) return of(usual);
  const double size = std::pow(10.0, std::uniform_real_distribution<>(-3, 3)(random_));
  return script::number_text(low ? key.least + size : key.greatest - size);
}

// Small: numbers of cells, of steps, of iterations are among them.
std::string Values::integer(const Key& key) {
  const int least = std::isfinite(key.least) ? static_cast<int>(std::max(key.least, -1e6)) : 0;
  const int greatest = std::isfinite(key.greatest) ? static_cast<int>(std::min(key.greatest, least + 5.0)) : least + 5;
  return std::to_string(least + below(std::max(greatest - least, 0) + 1));
}

std::string Values::file(const Key& key) {
  if (key.output) return once_in(10) ? "'nowhere/x.png'" : key.help.find(".vtu") != std::string::npos ? "'fuzz.vtu'" : "'fuzz.png'";
  return once_in(2) ? "'none'" : "'.'";
}

// Entries that are numbers where item is null. Vectors of cells are small integers, so that every vector often is.
std::string Values::list(const Key& key, std::size_t usual, const Key* item) {
  const auto most = std::min(key.most, key.fewest + 6);
  const auto count = std::clamp(usual, key.fewest, std::max(most, key.fewest));
  static const std::vector<std::string> counts = {"1", "2", "3", "4", "5"};
  const bool cells = !item && (key.name == "cells" || once_in(5));
  std::string entries;
  for (std::size_t i = 0; i < count; ++i) entries += (item ? value(*item) : cells ? of(counts) : number(Key{})) + ", ";
  return "{ " + entries + "}";
}

std::string Values::table(const Key& key) {
  std::string entries;
  if (!key.items.empty()) {
    const auto& item = key.items.front();
    const auto count = std::clamp<std::size_t>(static_cast<std::size_t>(1 + below(2)), item.fewest, std::max(item.fewest, std::min<std::size_t>(item.most, 9)));
    for (std::size_t i = 0; i < count; ++i) entries += value(item) + ", ";
  }
  for (const auto& one : key.keys) {
    const bool wanted = one.needed ? !once_in(40) : once_in(static_cast<int>(key.keys.size()) > 8 ? 6 : 3);
    if (wanted) entries += one.name + " = " + value(one) + ", ";
  }
  if (once_in(60)) entries += of(words) + " = 1, ";
  return "{ " + entries + "}";
}

std::string Values::function() { return of(once_in(4) ? odd_functions : functions); }

std::string Values::object(const std::string& type) {
  const auto found = pool_.find(type);
  if (found != pool_.end() && !once_in(4)) return of(found->second);
  const auto made = makers.find(type);
  if (made != makers.end()) return of(made->second);
  return found == pool_.end() ? "nil" : of(found->second);
}

std::string Values::arguments(const script::Descriptor& descriptor) {
  if (descriptor.takes_table()) return value(descriptor.arguments[0]);
  std::string text;
  for (const auto& argument : descriptor.arguments) {
    if (!argument.needed && once_in(2)) break;
    text += (text.empty() ? "" : ", ") + value(argument);
  }
  if (once_in(60)) text += (text.empty() ? "" : ", ") + wrong();
  return text;
}

}  // namespace dotyk::fuzz
