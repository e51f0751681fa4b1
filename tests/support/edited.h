#pragma once
#include <gtest/gtest.h>

#include <string>

namespace presa::test {

/// `text` with the one occurrence of `from` replaced.
inline std::string edited(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the text does not hold " << from;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << "the text holds twice " << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace presa::test
