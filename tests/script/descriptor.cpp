#include <doctest/doctest.h>

#include "bench.hpp"
#include "script/help/help.hpp"
#include "script/bridge/lua.hpp"

using namespace dotyk::script;

namespace {

// What is wrong with the descriptions: one line for each missing help text,
// example or key help. Empty when all is well.
std::vector<std::string> missing_help(const Library& library) {
  std::vector<std::string> missing;
  const auto check_keys = [&](const auto& self, const std::string& owner,
                              const std::vector<Key>& keys) -> void {
    for (const auto& key : keys) {
      const auto name = owner + ", '" + key.name + "'";
      if (key.help.empty()) missing.push_back(name + ": no help");
      self(self, name, inner_keys(key));
    }
  };
  const auto check = [&](const Descriptor& one) {
    if (one.help.empty()) missing.push_back(one.name + ": no help");
    if (one.example.empty()) missing.push_back(one.name + ": no example");
    check_keys(check_keys, one.name, one.keys());
  };
  for (const auto& one : library.functions()) check(one);
  for (const auto& type : library.types()) {
    if (type.help.empty()) missing.push_back(type.name + ": no help");
    for (const auto& field : type.fields) {
      if (field.help.empty()) missing.push_back(type.name + "." + field.name + ": no help");
    }
    for (const auto& method : type.methods) {
      if (method.owner() != type.name)
        missing.push_back(method.name + ": a method of " + type.name + " by another name");
      check(method);
    }
  }
  return missing;
}

}  // namespace

TEST_CASE("everything a script sees has help") {
  Interpreter interpreter;
  for (const auto& line : missing_help(interpreter.library())) FAIL_CHECK(line);
}

TEST_CASE("every example compiles") {
  Interpreter interpreter;
  const auto check = [&](const Descriptor& one) {
    INFO(one.name);
    const int status = luaL_loadstring(interpreter.state(), one.whole_example().c_str());
    const std::string message = status == LUA_OK ? "" : lua_tostring(interpreter.state(), -1);
    INFO(message);
    CHECK(status == LUA_OK);
    lua_settop(interpreter.state(), 0);
  };
  for (const auto& one : interpreter.library().functions()) check(one);
  for (const auto& type : interpreter.library().types()) {
    for (const auto& one : type.methods) check(one);
  }
}

TEST_CASE("types that descriptors name exist") {
  Interpreter interpreter;
  const auto& library = interpreter.library();
  const auto check_keys = [&](const auto& self, const std::string& owner,
                              const std::vector<Key>& keys) -> void {
    for (const auto& key : keys) {
      INFO(owner << ", " << key.name << ": type '" << key.type << "'");
      CHECK((key.kind != Kind::object || library.find_type(key.type)));
      self(self, owner, key.keys);
      self(self, owner, key.items);
    }
  };
  for (const auto& one : library.functions()) check_keys(check_keys, one.name, one.arguments);
  for (const auto& type : library.types()) {
    for (const auto& one : type.methods) check_keys(check_keys, one.name, one.arguments);
  }
}

TEST_CASE("a binding without help is found") {
  Bench bench;
  bench.interpreter.library().function({.name = "dotyk.bare", .run = [](Call&) { return 0; }});
  const auto missing = missing_help(bench.interpreter.library());
  CHECK(std::find(missing.begin(), missing.end(), "dotyk.bare: no help") != missing.end());
  CHECK(std::find(missing.begin(), missing.end(), "dotyk.bare: no example") != missing.end());
}

TEST_CASE("every name is registered once") {
  Interpreter interpreter;
  const auto& library = interpreter.library();
  std::vector<std::string> names;
  for (const auto& one : library.modules()) names.push_back(one.name);
  for (const auto& one : library.functions()) names.push_back(one.name);
  for (const auto& type : library.types()) {
    names.push_back("object " + type.name);
    for (const auto& one : type.methods) names.push_back(one.name);
  }
  std::sort(names.begin(), names.end());
  for (std::size_t k = 1; k < names.size(); ++k) CHECK(names[k] != names[k - 1]);
}

TEST_CASE("ranges in words") {
  CHECK(key::number("", "").expected() == "a number");
  CHECK(key::positive("", "").expected() == "a positive number");
  CHECK(key::number("", "").within(0, 1).expected() == "a number from 0 to 1");
  CHECK(key::number("", "").above(0).below(2).expected() == "a number above 0 and below 2");
  CHECK(key::number("", "").at_least(1).below(2).expected() == "a number of at least 1 and below 2");
  CHECK(key::number("", "").below(2).expected() == "a number below 2");
  CHECK(key::number("", "").at_least(0).or_infinite().expected() == "a number of at least 0 (math.huge too)");
}

TEST_CASE("signatures and help texts") {
  Bench bench;
  auto& library = bench.interpreter.library();
  REQUIRE(library.find("toy:grow"));
  CHECK(library.find("toy:grow")->signature() == "toy:grow(factor)");
  CHECK(library.find("dotyk.test.box")->signature() == "dotyk.test.box{ toys, …, gap = 0 }");
  const auto text = help_text(*library.find("dotyk.test.toy"));
  for (const char* part :
       {"Makes a toy.", "colour", "\"red\", \"green\" or \"blue\"; default \"red\"", "length", "Example:"}) {
    CHECK(text.find(part) != std::string::npos);
  }
  CHECK(help_text(library, *library.find_type("toy")).find("toy:grow") != std::string::npos);
  CHECK(reference_page(library).find("| `colour` |") != std::string::npos);
}

TEST_CASE("help and the reference list the keys of tables that are one of several kinds") {
  Interpreter interpreter;
  const auto& library = interpreter.library();
  const auto text = help_text(*library.find("dotyk.work_precision"));
  CHECK(text.find("\n      …") == std::string::npos);
  CHECK(text.find("\n      name            in table and legend\n") != std::string::npos);
  const auto page = reference_page(library);
  CHECK(page.find("| `methods[i].name` |") != std::string::npos);
  CHECK(page.find("….") == std::string::npos);
}

TEST_CASE("help says what the code does") {
  Interpreter interpreter;
  const auto& library = interpreter.library();
  const auto bound = help_text(*library.find_type("channel")->method("error_bound"));
  CHECK(bound.find("not negative") == std::string::npos);  // 0 is refused
  const auto plate = help_text(*library.find("dotyk.plate"));
  CHECK(plate.find("a law of dotyk.law but breaking") != std::string::npos);  // which plates refuse
}

TEST_CASE("help on a text that is no name does not repeat it") {
  Bench bench;
  CHECK(bench.error("help 'plan:\\n  one'") == "t.lua:1: help: nothing is called by a text of 11 letters; help() lists everything");
  CHECK(bench.error("help(('x'):rep(1000))").find("xxx") == std::string::npos);
  CHECK(bench.error("help 'dotyk.refernce'").find("did you mean 'dotyk.reference'?") != std::string::npos);
}

TEST_CASE("help on a word finds all that has it, names before texts") {
  Interpreter interpreter;
  const auto& library = interpreter.library();
  const auto found = [&](const std::string& word) { return help_search(library, word); };
  for (const auto& one : library.functions()) {
    INFO(one.name);
    CHECK(found(one.short_name()).find(one.name) != std::string::npos);
  }
  for (const auto& type : library.types()) {
    CHECK(found(type.name).find(type.name) != std::string::npos);
    for (const auto& one : type.methods) CHECK(found(one.short_name()).find(one.name) != std::string::npos);
    for (const auto& field : type.fields) CHECK(found(field.name).find(type.name + "." + field.name) != std::string::npos);
  }
  const auto load = found("load");
  const auto at = [&](const char* name) { return load.find(std::string("\n  ") + name + " "); };
  for (const char* name : {"part:load", "dotyk.law.load", "dotyk.beam{ load }"}) CHECK(at(name) != std::string::npos);
  CHECK(at("part:load") < at("dotyk.beam{ load }"));     // the very name, of functions before keys,
  CHECK(at("dotyk.beam{ load }") < at("dotyk.beam{ loads }"));
  CHECK(at("dotyk.beam{ loads }") < at("part:pressure"));  // then names that have it, then texts
  CHECK(found("force").find("dotyk.body{ force }") != std::string::npos);
  CHECK(found("von mises").find("solution:stress") != std::string::npos);
  CHECK(found("Von_Mises") == found("von mises"));
  for (const char* word : {"cone", "bolt", "contact", "write", "step", "render", "displacement"}) CHECK_FALSE(found(word).empty());
  CHECK(found("pdas").rfind("dotyk.solver.pdas{", 0) == 0);  // one thing alone is called so: its help, then where else
  CHECK(found("pdas").find("\nThe word is also in:\n") != std::string::npos);
  for (const char* none : {"xyzzy", "", " ", "%%", "orce"}) CHECK(found(none).empty());
}

TEST_CASE("callables written in Lua are checked like the others") {
  Bench bench;
  lua_State* L = bench.interpreter.state();
  lua_getfield(L, LUA_REGISTRYINDEX, "dotyk.loaded");
  REQUIRE(luaL_dostring(L, "return { add = function(t) return t.a + t.b end }") == LUA_OK);
  lua_setfield(L, -2, "test");  // as if it were a file of lua/
  bench.interpreter.library().function({.name = "dotyk.test.add",
                                        .help = "Adds.",
                                        .example = "dotyk.test.add{ a = 1 }",
                                        .arguments = {key::table({key::number("a", "one").required(), key::integer("b", "other").fallback(2.0)})},
                                        .in_lua = {"test", "add"}});
  CHECK(bench.error("local given = { a = 3 }\nassert(dotyk.test.add(given) == 5 and given.b == nil)") == "");
  CHECK(bench.error("dotyk.test.add{ a = 3, c = 3 }") ==
        "t.lua:1: add: unknown key 'c', expected 'a' or 'b'");
  CHECK(bench.interpreter.library().find("dotyk.test.add"));
}
