#include "framework/device/supervision/task.h"

#include <gtest/gtest.h>

namespace presa {
namespace {

TEST(SupervisorTask, CrossesAsText) {
  SupervisorTask task;
  task.rig_file = "rigs/desk.xml";
  task.binding.role = "thumb";
  task.binding.driver = "novint_falcon";
  task.binding.where = {"rigs/desk.xml", 4, 7};
  task.binding.settings["firmware"] = {"a folder/β.bin", {"rigs/desk.xml", 5, 9}};
  task.binding.settings["serial"] = {"", {}};
  const SupervisorTask same = unpackedTask(packed(task));
  EXPECT_EQ(same.rig_file, task.rig_file);
  EXPECT_EQ(same.binding.role, "thumb");
  EXPECT_EQ(same.binding.driver, "novint_falcon");
  EXPECT_EQ(same.binding.where.line, 4);
  ASSERT_EQ(same.binding.settings.size(), 2u);
  EXPECT_EQ(same.binding.settings.at("firmware").value, "a folder/β.bin");
  EXPECT_EQ(same.binding.settings.at("firmware").where.column, 9);
  EXPECT_EQ(same.binding.settings.at("serial").value, "");
}

TEST(SupervisorTask, SoDoFindingsAndNotes) {
  Diagnostics findings;
  findings.error(487, {"rig.xml", 3, 5}, "there is no Falcon", "plug it in");
  findings.warning(485, {"rig.xml", 4, 1}, "unknown firmware");
  EXPECT_EQ(unpackedFindings(packed(findings)).text(), findings.text());
  EXPECT_FALSE(unpackedFindings(packed(Diagnostics{})).hasErrors());
  const std::vector<std::string> lines{"one", "", "three"};
  EXPECT_EQ(unpackedLines(packed(lines)), lines);
}

TEST(SupervisorTask, TextThatEndsEarlyIsNoDanger) {
  SupervisorTask task;
  task.binding.driver = "scripted";
  task.binding.settings["key"] = {"value", {"rig.xml", 1, 2}};
  const std::string whole = packed(task);
  for (std::size_t length = 0; length <= whole.size(); ++length) unpackedTask({whole.data(), length});
}

}  // namespace
}  // namespace presa
