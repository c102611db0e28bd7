#include "script/complete/complete_context.hpp"

#include "script/complete/lua_tokens.hpp"

namespace dotyk::script {
namespace {

class ContextReader {
 public:
  explicit ContextReader(const std::string& text) : text_(text) {}

  Context read() {
    while (at_ < text_.size() && !context_.in_string) step();
    context_.value_of = key_;
    if (!context_.in_string) finish();
    return context_;
  }

 private:
  void step() {
    const Token token = next_token(text_, at_);
    const auto word = text_.substr(token.begin, token.after - token.begin);
    at_ = token.after;
    last_name_ended_ = std::string::npos;
    if (token.kind == Token::end) commented_ = token.open;
    else if (token.kind == Token::number) operation();
    else if (token.kind == Token::string) token.open ? in_string(token.begin + 1) : called();
    else if (token.kind == Token::sign) sign(word);
    else name(token, word);
  }

  void sign(const std::string& sign) {
    if (sign == "." || sign == ":") join(sign[0]);
    else if (sign == "(" || sign == "{" || sign == "[") open(sign[0]);
    else if (sign == ")" || sign == "}" || sign == "]") close(sign[0]);
    else if (sign == "," || sign == ";") separator();
    else if (sign == "=") equals();
    else operation();
  }

  void name(const Token& token, const std::string& word) {
    if (joined_) {
      chain_.push_back({joint_, word});
    } else if (token.kind == Token::keyword) {
      chain_.clear();
    } else {
      fresh_ = after_opening_;
      chain_ = {{Step::name, word}};
    }
    fresh_value_ = after_value_opening_;
    joined_ = false;
    after_opening_ = after_value_opening_ = false;
    last_name_began_ = token.begin;
    last_name_ended_ = at_;
  }

  void in_string(std::size_t start) {
    context_.in_string = true;
    context_.start = start;
    context_.word = text_.substr(start);
    context_.chain = chain_;
  }

  void join(char c) {
    joined_ = true;  // to nothing that is known, where the chain is empty
    joint_ = c == '.' ? Step::field : Step::method;
  }

  void open(char c) {
    context_.brackets.push_back({c, chain_, key_, at_, 0});
    chain_.clear();
    key_.clear();
    joined_ = false;
    after_opening_ = c == '{';
    after_value_opening_ = c == '(' && !context_.brackets.back().callee.empty();
  }

  void close(char c) {
    joined_ = after_opening_ = after_value_opening_ = false;
    chain_.clear();
    if (context_.brackets.empty()) return;
    const auto bracket = context_.brackets.back();
    context_.brackets.pop_back();
    key_ = bracket.key;
    chain_ = bracket.callee;
    if (c != ']') return called();
    if (!chain_.empty()) chain_.push_back(item(text_.substr(bracket.begin, at_ - 1 - bracket.begin)));
  }

  static Step item(const std::string& index) {
    const auto size = index.size();
    const bool quoted = size > 2 && (index[0] == '"' || index[0] == '\'') && index.find(index[0], 1) == size - 1;
    if (quoted && index.find('\\') == std::string::npos) return {Step::field, index.substr(1, size - 2)};
    const bool plain = size > 0 && size < 10 && index.find_first_not_of("0123456789") == std::string::npos;
    return {Step::item, plain ? index : ""};
  }

  // A string or a closed bracket after something calls it.
  void called() {
    if (!chain_.empty()) chain_.push_back({Step::call, ""});
    after_opening_ = after_value_opening_ = joined_ = false;
  }

  void separator() {
    operation();
    key_.clear();
    if (context_.brackets.empty()) return;
    auto& bracket = context_.brackets.back();
    ++bracket.finished;
    after_opening_ = bracket.sign == '{';
    after_value_opening_ = bracket.sign == '(' && !bracket.callee.empty();
  }

  void equals() {
    const bool is_key =
        fresh_ && chain_.size() == 1 && !context_.brackets.empty() && context_.brackets.back().sign == '{';
    const auto key = is_key ? chain_.front().text : "";
    operation();
    key_ = key;
    after_value_opening_ = is_key;
  }

  void operation() {
    chain_.clear();
    joined_ = after_opening_ = after_value_opening_ = false;
  }

  void finish() {
    const bool touching = last_name_ended_ == text_.size() && !text_.empty();
    context_.start = text_.size();
    if (commented_) return;
    if (touching && !chain_.empty()) {
      const auto last = chain_.back();
      chain_.pop_back();
      context_.start = last_name_began_;
      context_.word = last.text;
      context_.joint = last.kind;
      context_.chain = chain_;
      context_.key_position = last.kind == Step::name && fresh_;
      context_.value_position = last.kind == Step::name && fresh_value_;
    } else if (touching) {  // a keyword, or the beginning of a longer name
      context_.start = last_name_began_;
      context_.word = text_.substr(last_name_began_);
    } else if (joined_) {
      context_.joint = joint_;
      context_.chain = chain_;
    } else {
      context_.key_position = after_opening_;
      context_.value_position = after_value_opening_;
    }
  }

  const std::string& text_;
  Context context_;
  std::size_t at_ = 0;
  Chain chain_;
  std::string key_;      // the key whose value is being read
  bool joined_ = false;  // a '.' or ':' has just been read
  Step::Kind joint_ = Step::field;
  bool after_opening_ = false;  // a key may follow
  bool fresh_ = false;          // the chain began where a key may stand
  bool after_value_opening_ = false;  // a value, or an argument, begins
  bool fresh_value_ = false;          // the chain began there
  bool commented_ = false;
  std::size_t last_name_began_ = 0;
  std::size_t last_name_ended_ = std::string::npos;
};

}  // namespace

Context read_context(const std::string& text) { return ContextReader(text).read(); }

}  // namespace dotyk::script
