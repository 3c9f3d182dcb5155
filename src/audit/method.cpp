#include "audit/method.h"

#include <algorithm>
#include <utility>

#include "core/check.h"

namespace plumb::audit {
namespace {

template <class Range, class NameOf>
std::string joined(const Range& range, const NameOf& name_of_item) {
  std::string text;
  for (const auto& item : range)
    text += (text.empty() ? "" : ", ") + std::string(name_of_item(item));
  return text;
}

}  // namespace

std::unique_ptr<MethodRun> PreparedMethod::start() const {
  class EachForItself final : public MethodRun {
   public:
    explicit EachForItself(const PreparedMethod& method) : method_(method) {}
    DrawnSurface step(const Camera& camera, const Tolerance& tolerance) override {
      return method_.draw(camera, tolerance);
    }

   private:
    const PreparedMethod& method_;
  };
  return std::make_unique<EachForItself>(*this);
}

const Method& find_method(const MethodTable& table, const std::string& name) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const Method& method) { return method.name == name; });
  if (found == table.end()) {
    input_error("method '{}': expected one of {}", name,
                joined(table, [](const Method& method) { return method.name; }));
  }
  return *found;
}

MethodChoice resolved_choice(const Method& method, MethodChoice choice) {
  const auto& variants = method.variants;
  if (choice.variant.empty()) choice.variant = variants.front();
  if (std::find(variants.begin(), variants.end(), choice.variant) == variants.end()) {
    input_error("method {} has no variant '{}': it has {}", method.name, choice.variant,
                joined(variants, [](const std::string& variant) { return variant; }));
  }
  for (const auto& [key, value] : choice.parameters) {
    const bool known = std::any_of(method.parameters.begin(), method.parameters.end(),
                                   [&k = key](const auto& p) { return p.first == k; });
    if (!known) {
      input_error("method {} has no parameter '{}': it has {}", method.name, key,
                  method.parameters.empty() ? "none" : joined(method.parameters, [](const auto& p) {
                    return p.first;
                  }));
    }
  }
  return method.resolve ? method.resolve(std::move(choice)) : choice;
}

std::unique_ptr<PreparedMethod> prepare_method(const Method& method,
                                               const terrain::Heightfield& field,
                                               const MethodChoice& choice,
                                               const Tolerance& tolerance) {
  const MethodChoice settled = resolved_choice(method, choice);
  const auto& units = method.tolerance_units;
  if (std::find(units.begin(), units.end(), tolerance.unit) == units.end()) {
    input_error("method {} promises nothing in '{}': give a tolerance in {}", method.name,
                name_of(tolerance.unit), joined(units, [](Unit unit) { return name_of(unit); }));
  }
  require_drawable(method, field);
  return method.prepare(field, settled);
}

void require_drawable(const Method& method, const terrain::Heightfield& field) {
  if (field.stacks != nullptr && !method.takes_stacks)
    input_error(
        "method {} draws heights, and {} is a terrain of stacks: method stacks draws it, or "
        "--surface top asks for its top surface",
        method.name, field.provenance.source);
}

DrawnSurface full_detail_of_stacks(const MethodTable& table, const terrain::Heightfield& field,
                                   const Method* method, const MethodChoice& choice) {
  require(field.stacks != nullptr, "only a terrain of stacks has a full-detail mesh of stacks");
  if (method != nullptr && method->full_detail)
    return method->full_detail(field, resolved_choice(*method, choice));
  const auto found = std::find_if(table.begin(), table.end(),
                                  [](const Method& row) { return row.full_detail != nullptr; });
  require(found != table.end(), "no method of the table draws stacks");
  return found->full_detail(field, resolved_choice(*found, {}));
}

}  // namespace plumb::audit
