// Help, and the list of all that is bound.
#include "script/bind/bind.hpp"

#include <cstdio>

#include "script/help/help.hpp"
#include "script/help/nearest.hpp"
#include "script/prompt/terminal.hpp"
#include "script/bridge/position.hpp"

namespace dotyk::script {
namespace {

// A result that is a text, scene:plan() say, is not repeated as if it were a name.
void require_name(const std::string& text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest && text.find('\n') == std::string::npos) return;
  throw ArgumentError("nothing is called by a text of " + std::to_string(letters(text)) + " letters; help() lists everything");
}

std::string help_on_name(const Library& library, const std::string& name) {
  require_name(name);
  if (name == "prompt") return help_on_prompt();
  for (const auto& module : library.modules())
    if (module.name == name) return help_text(library, module);
  if (const auto* descriptor = library.find(name)) return help_text(*descriptor);
  const auto found = help_search(library, name);
  if (!found.empty()) return found;
  const auto near = nearest(name, library.names());
  throw ArgumentError("nothing is called '" + name + "'" +
                      (near.empty() ? "; help() lists everything" : ", did you mean '" + near + "'?"));
}

// A function of the user's own.
std::string help_on_own(lua_State* L, int index) {
  lua_Debug info;
  lua_pushvalue(L, index);
  lua_getinfo(L, ">Su", &info);
  const std::string arguments = std::to_string(info.nparams) + (info.isvararg ? " or more arguments" : info.nparams == 1 ? " argument" : " arguments");
  return std::string("A Lua function of ") + arguments + ", written at " + info.short_src + ":" + std::to_string(info.linedefined) + "; source(f), or f??, shows it.\n";
}

std::string help_on_value(const Call& call) {
  lua_State* L = call.state();
  const auto& library = Library::of(L);
  const int index = call.slot("x");
  if (lua_type(L, index) == LUA_TSTRING) return help_on_name(library, lua_tostring(L, index));
  if (const auto* descriptor = descriptor_at(L, index)) return help_text(*descriptor);
  if (const auto* type = library.type_at(L, index)) return help_text(library, *type);
  const auto module = library.module_at(L, index);
  if (!module.empty()) return help_on_name(library, module);
  if (lua_type(L, index) == LUA_TFUNCTION && !lua_iscfunction(L, index)) return help_on_own(L, index);
  throw ArgumentError("there is no help on " + describe_value(L, index) + "; help() lists everything");
}

void bind_help(Library& library) {
  library.function(
      {.name = "help",
       .help = "Prints help: on everything, on a function, method, object or name, and on a word whatever has it in its name "
               "or text; help \"prompt\" on the prompt.",
       .example = "help()\nhelp(dotyk)\nhelp \"help\"\nhelp \"force\"\nhelp \"prompt\"",
       .arguments = {key::any("x", "a function, a method, an object, a table of functions, a name, or a word")},
       .run = [](Call& call) {
         const auto& library = Library::of(call.state());
         const auto text = call.has("x") ? help_on_value(call) : help_index(library);
         if (library.folder) std::fputs(text.c_str(), stdout);  // --safe starts no program
         else show_paged(text);
         return 0;
       }});
  library.function({.name = "dotyk.reference",
                    .help = "The reference of everything callable, as a Markdown text.",
                    .example = "local page = dotyk.reference()",
                    .run = [](Call& call) { return call.give(reference_page(Library::of(call.state()))); }});
}

}  // namespace

void bind_all(Library& library) {
  library.module("dotyk", "Unilateral contact problems: describe bodies and contacts, solve, look. Strains and rotations are small: no finite sliding, no buckling, no rubber squeezed flat.");
  for (const auto bind :
       {bind_help, bind_material, bind_mesh, bind_refinement, bind_body, bind_scene, bind_solver, bind_ranks, bind_repeated, bind_shape, bind_solution,
        bind_figure, bind_program, bind_fclib, bind_law, bind_beam, bind_channel, bind_thermoelastic, bind_beam_figure, bind_plate, bind_lua})
    bind(library);
}

}  // namespace dotyk::script
