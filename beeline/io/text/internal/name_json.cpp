#include <beeline/error.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/name_json.h>

namespace beeline::internal {

std::string name_from_json(const JsonDocument& document, const Json& json) {
  const std::string& name = document.text(json);
  try {
    check_name(name, "is refused: the name");
  } catch (const Error& error) {
    document.refuse(json, error.what());
  }
  return name;
}

}  // namespace beeline::internal
