#include <cstdio>
#include <map>
#include <memory>

#include "apps/presa/commands/commands.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/scene/manifest.h"
#include "framework/scene/xml/schema.h"

namespace presa {
namespace {

enum SchemaCode { kNoSuchElement = 599 };

struct SchemaArguments {
  std::string path;
  bool xsd = false;
};

std::string occurrence(const xml::ContentRule& content) {
  if (content.options.size() > 1 && content.max == 1)
    return content.min > 0 ? "one of several" : "at most one of several";
  if (content.max == 1) return content.min > 0 ? "once" : "at most once";
  return content.min > 0 ? "once or more" : "any number";
}

/// Prints elements by their path, which is also their path in --set.
class Page {
 public:
  explicit Page(std::string wanted) : wanted_(std::move(wanted)) {
    for (const Manifest& manifest : manifests()) {
      for (const Manifest::Element& element : manifest.elements) plugin_of_[element.name] = &manifest;
    }
  }

  void print(const xml::ElementRule& rule, const std::string& path, const std::string& how_often) {
    if (wanted_.empty() || ("/" + path + "/").find("/" + wanted_ + "/") != std::string::npos)
      printOne(rule, path, how_often);
    for (const xml::ContentRule& content : rule.content) {
      for (const xml::ElementRule* child : content.options)
        print(*child, (path.empty() ? "" : path + "/") + child->name, occurrence(content));
    }
  }
  std::size_t printed() const noexcept { return printed_; }

 private:
  void printOne(const xml::ElementRule& rule, const std::string& path, const std::string& how_often) {
    ++printed_;
    std::printf("%s (%s)", path.empty() ? "scene" : path.c_str(), how_often.c_str());
    const auto plugin = plugin_of_.find(rule.name);
    if (plugin != plugin_of_.end())
      std::printf(", of plug-in %s: %s", plugin->second->name.c_str(), plugin->second->about.c_str());
    std::printf("\n");
    for (const xml::AttributeRule& attribute : rule.attributes) {
      const std::string given =
          attribute.required ? ", required"
          : attribute.default_value
              ? ", default " + (attribute.default_value->empty() ? "''" : *attribute.default_value)
              : "";
      std::printf("  %-22s %s%s%s\n", attribute.name.c_str(), describe(attribute.value).c_str(), given.c_str(),
                  attribute.documentation.empty() ? "" : (": " + attribute.documentation).c_str());
    }
  }

  std::string wanted_;
  std::map<std::string, const Manifest*> plugin_of_;
  std::size_t printed_ = 0;
};

int printSchema(const SchemaArguments& arguments) {
  const std::string xsd = sceneSchemaWith(manifests());
  if (arguments.xsd) {
    std::fputs(xsd.c_str(), stdout);
    return kExitOk;
  }
  const xml::Schema schema(xsd);
  Page page(arguments.path);
  page.print(schema.root(), "", "once");
  if (page.printed() == 0) {
    refuse(kNoSuchElement, "", "no element of scenes has the path " + quote(arguments.path),
           "presa schema lists all of them");
  }
  return kExitOk;
}

}  // namespace

void addSchema(Command app, int& status) {
  auto arguments = std::make_shared<SchemaArguments>();
  Command command = app.command("schema", "Every element and attribute of scenes, those of plug-ins included");
  command.option("PATH", arguments->path, "only the elements below this path or name, e.g. body/haptic or magnet");
  command.flag("--xsd", arguments->xsd, "the XML schema instead, for an editor that completes and checks while typing");
  command.footer(
      "Paths are those of --set, where a name may follow an element: body/cube/magnet/range=0.05.\n"
      "Examples:  presa schema magnet\n"
      "           presa schema --xsd > scene.xsd");
  command.action([arguments, &status] { status = printSchema(*arguments); });
}

}  // namespace presa
