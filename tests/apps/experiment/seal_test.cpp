#include "apps/experiment/seal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "apps/common/file_text.h"
#include "apps/common/scratch_folder.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/checksum/plugin.h"
#include "framework/record/checksum/signature.h"

// Signatures prove the identity of the sealer, which a checksum cannot.
namespace presa::experiment {
namespace {

using testing::HasSubstr;

// Test 2 of RFC 8032, section 7.1: key, message and signature of the standard.
TEST(Signature, IsThatOfTheStandard) {
  const std::string secret =
      "presa-secret-key ed25519 4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb\n";
  const std::string open =
      "presa-public-key ed25519 3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c\n";
  const std::string expected =
      "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e458f3613d0f11d8c387b2eaeb4302aee"
      "b"
      "00d291612bb0c00";
  EXPECT_EQ(signMessage(secret, "\x72"), expected);
  EXPECT_TRUE(isSignedBy(open, "\x72", expected));
}

// A change of any bit of message, signature or key is detected.
TEST(Signature, FitsOneMessageAndOneKey) {
  const KeyPair keys = makeKeys(), others = makeKeys();
  EXPECT_NE(keys.secret, others.secret);
  const std::string signature = signMessage(keys.secret, "message");
  EXPECT_TRUE(isSignedBy(keys.open, "message", signature));
  EXPECT_FALSE(isSignedBy(keys.open, "messagf", signature));
  EXPECT_FALSE(isSignedBy(others.open, "message", signature));
  for (std::size_t i = 0; i < signature.size(); ++i) {
    std::string changed = signature;
    changed[i] = changed[i] == '0' ? '1' : '0';
    EXPECT_FALSE(isSignedBy(keys.open, "message", changed)) << i;
  }
  for (const std::string& wrong : {std::string(), signature + "0", std::string(128, 'x')})
    EXPECT_FALSE(isSignedBy(keys.open, "message", wrong));
  EXPECT_THROW(signMessage(keys.open, "message"), std::invalid_argument);
  EXPECT_THROW(isSignedBy(keys.secret, "message", signature), std::invalid_argument);
}

class SealTest : public testing::Test {
 protected:
  ScratchFolder scratch;
  SessionFolder folder{scratch.path().string()};
  std::string key = scratch.file("lab.key");
};

TEST_F(SealTest, KeysAreForTheirOwnerAndNeverOverwritten) {
  makeKeyFiles(key);
  struct stat info {};
  ASSERT_EQ(::stat(key.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600u);
  const std::string before = contentsOf(key);
  EXPECT_THROW(makeKeyFiles(key), InputError);
  EXPECT_EQ(contentsOf(key), before);
}

TEST_F(SealTest, ASignedSealIsProvenAndNoOther) {
  makeKeyFiles(key);
  makeKeyFiles(scratch.file("other.key"));
  EXPECT_THAT(signatureTrouble(folder, "abc", key + ".pub").value_or(""), HasSubstr("not signed"));
  signSeal(folder, "abc", key);
  EXPECT_EQ(signatureTrouble(folder, "abc", key + ".pub"), std::nullopt);
  EXPECT_THAT(signatureTrouble(folder, "abd", key + ".pub").value_or(""), HasSubstr("not the signature"));
  EXPECT_THAT(signatureTrouble(folder, "abc", scratch.file("other.key.pub")).value_or(""),
              HasSubstr("not the signature"));
  EXPECT_THROW(signatureTrouble(folder, "abc", key), InputError) << "the secret key is no public one";
  EXPECT_THROW(signSeal(folder, "abc", key + ".pub"), InputError);
  std::ofstream(folder.file(kSignatureFile)) << "[1, 2";
  EXPECT_THAT(signatureTrouble(folder, "abc", key + ".pub").value_or(""), HasSubstr("not the signature"));
}

}  // namespace
}  // namespace presa::experiment
