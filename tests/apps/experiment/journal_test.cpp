#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/journal.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/checksum/checksum.h"
#include "tests/apps/experiment/contents.h"
#include "tests/apps/experiment/refusal.h"

namespace presa::experiment {
namespace {

using testing::HasSubstr;

Json record(int i) { return {{"event", "trial"}, {"i", i}, {"x", 0.1 * i}, {"text", "a \"b\"\n"}}; }

class JournalTest : public testing::Test {
 protected:
  JournalTest() {
    Journal journal = Journal::create(file);
    for (int i = 0; i < 5; ++i) journal.append(record(i));
    text = contentsOf(file);
  }
  void write(const std::string& changed) { std::ofstream(file, std::ios::binary) << changed; }
  ScratchFolder scratch;
  const std::string file = scratch.file("journal.jsonl");
  std::string text;
};

TEST_F(JournalTest, GivesBackWhatWasWritten) {
  const auto contents = Journal::read(file);
  ASSERT_EQ(contents.records.size(), 5U);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(contents.records[static_cast<std::size_t>(i)], record(i));
  EXPECT_EQ(contents.torn_bytes, 0U);
}

TEST_F(JournalTest, IsNeverOverwritten) {
  EXPECT_THAT(refusalOf([&] { Journal::create(file); }), HasSubstr("error[E920]"));
  EXPECT_EQ(contentsOf(file), text);
}

// A log cut at any byte holds the complete records before the cut and can be continued from there.
TEST_F(JournalTest, CutAnywhereItGoesOn) {
  std::size_t whole = 0;
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    if (cut > 0 && text[cut - 1] == '\n') ++whole;
    write(text.substr(0, cut));
    Journal::Contents contents;
    {
      Journal journal = Journal::reopen(file, contents);
      ASSERT_EQ(contents.records.size(), whole) << cut;
      journal.append(record(77));
    }
    const auto after = Journal::read(file);
    ASSERT_EQ(after.records.size(), whole + 1);
    ASSERT_EQ(after.torn_bytes, 0U);
    ASSERT_EQ(after.records.back(), record(77));
  }
}

// A change of any byte in any complete line is found, including the last line, and so is a removed line.
TEST_F(JournalTest, AChangeInAWholeLineIsFound) {
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    std::string changed = text;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    write(changed);
    ASSERT_THAT(refusalOf([&] { Journal::read(file); }), HasSubstr("error[E923]")) << at;
  }
  const std::size_t first = text.find('\n') + 1, second = text.find('\n', first) + 1;
  write(text.substr(0, first) + text.substr(second));
  EXPECT_THAT(refusalOf([&] { Journal::read(file); }), HasSubstr("error[E923]"));
}

// A crash leaves only an incomplete line: a damaged complete line is evidence and must not be cut off.
TEST_F(JournalTest, ADamagedLastLineIsNotCutOff) {
  std::string changed = text;
  changed[text.size() - 3] = ' ';
  write(changed);
  Journal::Contents contents;
  EXPECT_THAT(refusalOf([&] { Journal::reopen(file, contents); }), HasSubstr("line 5 was changed"));
  EXPECT_EQ(contentsOf(file), changed);
}

// The chain by hand: each sum is the SHA-256 of the previous sum followed by the record.
TEST_F(JournalTest, IsAChainOfSha256) {
  std::string sum;
  for (int i = 0; i < 5; ++i) {
    std::ofstream(scratch.file("link"), std::ios::binary) << sum << record(i).dump();
    sum = sha256OfFile(scratch.file("link"));
    EXPECT_THAT(text, HasSubstr("{\"sha256\":\"" + sum + "\",\"record\":" + record(i).dump() + "}\n"));
  }
  EXPECT_EQ(Journal::read(file).sum, sum);
}

TEST_F(JournalTest, TheFormatBeforeIsNamed) {
  write("{\"sum\":\"cbf29ce484222325\",\"record\":{}}\n");
  EXPECT_THAT(refusalOf([&] { Journal::read(file); }), HasSubstr("whose checksums are too weak"));
}

TEST_F(JournalTest, OneProcessAtATime) {
  Journal::Contents contents;
  const Journal held = Journal::reopen(file, contents);
  EXPECT_THAT(refusalOf([&] { Journal::reopen(file, contents); }), HasSubstr("error[E921]"));
}

// A file size limit stops a write half-way, as a full disk does.
TEST_F(JournalTest, AFullDiskLeavesTheRecordsBefore) {
  Journal::Contents contents;
  Journal journal = Journal::reopen(file, contents);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit full{text.size() + 20, before.rlim_max};
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &full);
  EXPECT_THROW(journal.append(record(1)), std::system_error);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old);
  EXPECT_EQ(contentsOf(file), text);
  journal.append(record(2));  // with room again
  EXPECT_EQ(Journal::read(file).records.size(), 6U);
}

TEST(Checksum, IsThatOfTheStandard) {
  ScratchFolder scratch;
  std::ofstream(scratch.file("abc")) << "abc";  // FIPS 180-2, example B.1
  EXPECT_EQ(sha256OfFile(scratch.file("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256OfText("abc"), sha256OfFile(scratch.file("abc")));
  EXPECT_THROW(sha256OfFile(scratch.file("none")), std::system_error);
  Sha256 sum;
  sum.add("a", 1);
  sum.add("bc", 2);
  EXPECT_EQ(sum.finish(), sha256OfText("abc"));
  EXPECT_EQ(sum.finish(), sha256OfText(""));  // after finish() it starts over
}

}  // namespace
}  // namespace presa::experiment
