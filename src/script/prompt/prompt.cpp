#include "script/prompt/prompt.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <ctime>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/stopwatch.hpp"
#include "script/bridge/lua_side.hpp"
#include "script/bridge/position.hpp"
#include "script/bridge/push.hpp"
#include "script/complete/complete_context.hpp"
#include "script/interpreter.hpp"
#include "script/prompt/interrupt.hpp"
#include "script/prompt/kept_locals.hpp"
#include "script/prompt/line_reader.hpp"
#include "script/prompt/watch.hpp"

namespace dotyk::script {
namespace {

std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> all;
  for (Token token = next_token(text, 0); token.kind != Token::end; token = next_token(text, token.after))
    all.push_back(text.substr(token.begin, token.after - token.begin));
  return all;
}

// A name or a keyword.
bool is_word(const std::string& token) { return std::isalpha(static_cast<unsigned char>(token[0])) || token[0] == '_'; }

const auto chunk_name = std::string("=") + prompt_chunk;

class Prompt {
 public:
  explicit Prompt(Interpreter& interpreter)
      : interpreter_(interpreter),
        L_(interpreter.state()),
        terminal_(isatty(STDIN_FILENO) && isatty(STDOUT_FILENO)) {}

  int run() {
    if (terminal_) {
      keep_session();
      if (const auto& reason = load_history(); !reason.empty()) std::fprintf(stderr, "dotyk: history is not kept: %s\n", reason.c_str());
      std::printf("dotyk %s – help() lists what there is, Ctrl-D leaves\n", DOTYK_VERSION);
    }
    bool failed = false;
    std::string input;
    for (;;) {
      const auto read = next_line(input);
      if (read == Read::end && input.empty()) break;
      if (read == Read::cleared) {
        remember(input);  // a slip in a long input is mended there
        input.clear();
        continue;
      }
      if (wants_out(input)) break;
      if (read == Read::end && terminal_) std::putchar('\n');
      if (!evaluate(input, read == Read::end)) continue;  // wants more lines
      failed = failed || failed_;
      input.clear();
      if (read == Read::end && !terminal_) break;  // a person's Ctrl-D ends what was begun
    }
    if (terminal_) std::putchar('\n');
    return failed && !terminal_ ? 1 : 0;
  }

 private:
  // Adds a line to the input, of those pasted together one after the other.
  Read next_line(std::string& input) {
    if (!pending_.empty()) {
      add_line(input);
      return Read::line;
    }
    std::string typed;
    const auto complete_line = [&](const std::string& text) {
      return complete(L_, input.empty() ? text : input + "\n" + text);
    };
    std::fflush(stdout);
    const auto read =
        terminal_ ? read_edited(input.empty() ? "> " : ">> ", typed, complete_line) : read_plain(typed);
    if (read != Read::line) return read;
    pending_ = lines_of(typed);
    add_line(input);
    return read;
  }

  void add_line(std::string& input) {
    do {
      input += (input.empty() ? "" : "\n") + pending_.front();
      pending_.pop_front();
    } while (!pending_.empty() && goes_on_with(pending_.front()));
  }

  void remember(const std::string& input) const {
    if (terminal_) add_to_history(input);
  }

  static bool ends_early(const std::string& message) { return message.ends_with("<eof>"); }

  // Compiles the text; the function, or else the message, is left on the stack.
  bool load(const std::string& text) {
    return luaL_loadbufferx(L_, text.data(), text.size(), chunk_name.c_str(), "t") == LUA_OK;
  }

  // The input as Lua compiles it: "= expr" without its sign, and, as each input
  // is a chunk of its own, "local x = …" without "local", so that x can be used
  // in the next line as in the script it was copied from. (Further locals of the
  // input stay by keep_locals.)
  std::string plain(const std::string& input) {
    if (!input.empty() && input[0] == '=') return input.substr(1);
    const auto global = as_globals(input);
    if (global == input) return input;
    const bool fits = load(global) || ends_early(lua_tostring(L_, -1));
    lua_pop(L_, 1);
    return fits ? global : input;
  }

  bool is_variable(const std::string& name) {
    lua_pushglobaltable(L_);
    lua_pushstring(L_, name.c_str());
    const bool is = lua_rawget(L_, -2) != LUA_TNIL;
    lua_pop(L_, 2);
    return is;
  }

  // Returns false when the input is the beginning of something longer.
  bool evaluate(const std::string& input, bool last) {
    if (input.empty() || input[0] != '%') return run_input(input, input, last, false);
    constexpr std::string_view time = "%time";
    const auto start = input.find_first_not_of(" \t", time.size());
    if (input.compare(0, time.size(), time) != 0 || start == std::string::npos || start == time.size()) {
      remember(input);
      report("prompt: after % comes time and an expression: %time dotyk.solve(scene)");
      return true;
    }
    return run_input(input, input.substr(start), last, true);
  }

  enum class Compiled { expression, statement, not_yet, wrong };

  // Leaves the function, or the message of what is wrong, on the stack.
  Compiled compile(const std::string& text, bool last) {
    compiled_ = "return " + text;
    if (load(compiled_)) return Compiled::expression;
    const std::string as_expression = lua_tostring(L_, -1);
    lua_pop(L_, 1);
    if (load(text)) {
      const bool declares = text.find("local") != std::string::npos;
      compiled_ = declares ? keep_locals(L_, text, chunk_name) : text;
      return Compiled::statement;
    }
    const std::string message = lua_tostring(L_, -1);
    return !last && (ends_early(message) || ends_early(as_expression)) ? Compiled::not_yet : Compiled::wrong;
  }

  bool run_input(const std::string& typed, const std::string& input, bool last, bool timed) {
    failed_ = false;
    const auto asked = question(input, [&](const std::string& name) { return is_variable(name); });
    const auto compiled = compile(asked.empty() ? plain(input) : asked, last);
    if (compiled == Compiled::not_yet) {
      lua_pop(L_, 1);
      return false;
    }
    remember(typed);
    if (compiled == Compiled::wrong) {
      report(lua_tostring(L_, -1));
      lua_pop(L_, 1);
      return true;
    }
    keep_for_source(input);
    const Stopwatch watch;
    const std::clock_t used = std::clock();
    run_function();
    if (timed && !failed_)
      std::printf("%.3g s, %.3g s of processors\n", watch.seconds(), static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC);
    return true;
  }

  // The text of a function typed is found again by what it compiles to (lua/source.lua).
  void keep_for_source(const std::string& input) {
    if (compiled_.find("function") == std::string::npos) return;
    luaL_getsubtable(L_, LUA_REGISTRYINDEX, inputs_of_prompt);
    lua_createtable(L_, 0, 2);
    set_field(L_, "typed", input);
    set_field(L_, "compiled", compiled_);
    lua_rawseti(L_, -2, static_cast<lua_Integer>(lua_rawlen(L_, -2)) + 1);
    lua_pop(L_, 1);
  }

  void run_function() {
    const int base = lua_gettop(L_) - 1;
    auto error = interpreter_.call(0, LUA_MULTRET);
    const int count = lua_gettop(L_) - base;
    if (!error && count > 0 && !lua_isnil(L_, base + 1)) {
      lua_pushglobaltable(L_);
      lua_pushliteral(L_, "_");
      lua_pushvalue(L_, base + 1);
      lua_rawset(L_, -3);  // by no metamethod, whose error nothing here would catch
      lua_pop(L_, 1);
    }
    if (!error && count > 0) error = show_values(count);
    lua_settop(L_, base);
    clear_interrupt();
    forget_judged();
    if (error) report(*error);
  }

  // Prints the values on top of the stack with the show function of lua/show.lua.
  std::optional<std::string> show_values(int count) {
    push_own_function(L_, "show", "print");
    lua_insert(L_, -count - 1);
    return interpreter_.call(count, 0);
  }

  void report(const std::string& message) {
    failed_ = true;
    pending_.clear();
    std::fflush(stdout);
    std::fprintf(stderr, "%s\n", message.c_str());
  }

  Interpreter& interpreter_;
  lua_State* L_;
  std::deque<std::string> pending_;  // lines that came with those being evaluated
  std::string compiled_;             // the text of the function to be run
  bool terminal_, failed_ = false;
};

}  // namespace

bool wants_out(const std::string& input) {
  auto tokens = tokens_of(input);
  if (!tokens.empty() && tokens.back() == ";") tokens.pop_back();
  if (tokens.size() == 3 && tokens[1] == "(" && tokens[2] == ")") tokens.resize(1);
  return tokens.size() == 1 && (tokens[0] == "exit" || tokens[0] == "quit");
}

std::string question(const std::string& input, const std::function<bool(const std::string&)>& is_variable) {
  const auto tokens = tokens_of(input);
  auto at = tokens.begin();
  const auto take = [&](const char* token) { return at != tokens.end() && *at == token && (++at, true); };
  const bool help = tokens.size() > 1 && is_word(tokens[1]) && take("help");
  const bool asked = help || take("?");
  if (at == tokens.end() || !is_word(*at)) return "";
  const std::string first = *at++;
  std::string rest;  // ".field:method"
  for (; tokens.end() - at >= 2 && (*at == "." || *at == ":") && is_word(at[1]); at += 2) rest += at[0] + at[1];
  if (!asked && !take("?")) return "";
  const bool source = !asked && take("?");
  if (at != tokens.end()) return "";
  if (!is_variable(first)) return "help \"" + first + rest + "\"";
  std::replace(rest.begin(), rest.end(), ':', '.');
  return (source ? "source(" : "help(") + first + rest + ")";
}

std::deque<std::string> lines_of(const std::string& text) {
  std::deque<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  if (lines.empty()) lines.emplace_back();
  return lines;
}

bool goes_on_with(const std::string& line) {
  const auto tokens = tokens_of(line);
  if (tokens.empty()) return false;
  const std::string& first = tokens[0];
  if (first == ":") return tokens.size() > 1;
  return first == "and" || first == "or" || std::string(".+*/%^,=<>~)}]").find(first[0]) != std::string::npos;
}

int run_prompt(Interpreter& interpreter) { return Prompt(interpreter).run(); }

}  // namespace dotyk::script
