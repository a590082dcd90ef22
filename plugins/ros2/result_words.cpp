#include "result_words.hpp"

#include <rosidl_runtime_c/string.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

#include "field_values.hpp"
#include "package_index.hpp"

namespace ros2 {
namespace {

using Constants = std::vector<std::pair<std::string, std::int64_t>>;

constexpr std::string_view kCodes[] = {"code", "error", "status", "result", "state"};
constexpr std::string_view kTexts[] = {"msg",         "message", "string", "text",  "reason",
                                       "description", "details", "info",   "error", "status"};

template <std::size_t kCount>
bool ends_with_one(std::string_view name, const std::string_view (&words)[kCount]) {
  return std::any_of(std::begin(words), std::end(words), [&](std::string_view word) {
    return name.size() >= word.size() && name.substr(name.size() - word.size()) == word;
  });
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream text(path);
  for (std::string part; std::getline(text, part, '.');) parts.push_back(part);
  return parts;
}

// "nav2_msgs__action" and "FollowPath_Result": the constants are in nav2_msgs/action/FollowPath.
TypeName type_of(const Members& message) {
  const std::string space = message.message_namespace_;
  const auto between = space.find("__");
  TypeName type{space.substr(0, between), "", message.message_name_};
  if (between != std::string::npos) type.kind = space.substr(between + 2);
  if (type.kind != "msg") type.name.erase(std::min(type.name.find('_'), type.name.size()));
  return type;
}

// "const uint16 TIMEOUT = 104;", within the module of the message.
Constants constants_of(const Members& message) {
  Constants constants;
  std::ifstream file(interface_file(type_of(message)));
  const std::string module = "module " + std::string(message.message_name_) + "_Constants {";
  bool is_inside = false;
  for (std::string line; std::getline(file, line);) {
    line.erase(0, line.find_first_not_of(' '));
    if (line == module) is_inside = true;
    if (is_inside && line == "};") break;
    std::istringstream words(line);
    std::string word, type, name, equals;
    std::int64_t value = 0;
    const bool is_constant = words >> word >> type >> name >> equals >> value && word == "const";
    if (is_inside && is_constant) constants.emplace_back(name, value);
  }
  return constants;
}

// The message that has the field itself.
const Members& owner_of(const Members& message, const std::vector<std::string>& parts) {
  const Members* owner = &message;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    owner = &members_of(member_named(*owner, parts[i].c_str()));
  }
  return *owner;
}

// Of several constants with the value, the one with the first word of the field: a message may have
// several kinds of codes.
std::string name_of(const Constants& constants, const std::string& field, std::int64_t value) {
  std::string first_word = field.substr(0, field.find('_'));
  for (char& it : first_word) it = static_cast<char>(std::toupper(static_cast<unsigned char>(it)));
  std::string found;
  for (const auto& [name, its] : constants) {
    if (its != value) continue;
    if (name.rfind(first_word + "_", 0) == 0) return name;
    if (found.empty()) found = name;
  }
  return found;
}

}  // namespace

ResultWords::ResultWords(const Members& message, const std::vector<Field>& fields) {
  std::vector<const Field*> strings;
  for (const Field& field : fields) {
    if (field.rows != nullptr || field.path.empty()) continue;
    const auto parts = parts_of(field.path);
    if (field.kind == Field::Kind::String) {
      strings.push_back(&field);
      if (ends_with_one(parts.back(), kTexts)) texts_.push_back(&field);
    }
    const auto is_code = [](const std::string& part) { return ends_with_one(part, kCodes); };
    if (field.kind == Field::Kind::Int && std::any_of(parts.begin(), parts.end(), is_code)) {
      codes_.push_back({&field, constants_of(owner_of(message, parts))});
    }
  }
  if (texts_.empty() && strings.size() == 1) texts_ = strings;
}

std::string ResultWords::text(const void* message) const {
  std::string all;
  const char* before = ": ";
  for (const auto& [field, constants] : codes_) {
    const auto value = static_cast<std::int64_t>(number_in(*field, message).value_or(0));
    if (value == 0) continue;
    const std::string name = name_of(constants, parts_of(field->path).back(), value);
    const std::string number = std::to_string(value);
    all += before + (name.empty() ? field->path + " " + number : name + " (" + number + ")");
    before = ", ";
  }
  before = ": ";
  for (const Field* const field : texts_) {
    const auto& text = *reinterpret_cast<const rosidl_runtime_c__String*>(
        static_cast<const unsigned char*>(message) + field->offset);
    if (text.size == 0) continue;
    all += before + std::string(text.data, text.size);
    before = ", ";
  }
  return all;
}

}  // namespace ros2
