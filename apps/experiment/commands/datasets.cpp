#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "apps/experiment/commands/experiment_commands.h"
#include "apps/experiment/dataset.h"
#include "apps/experiment/forget.h"
#include "apps/experiment/seal.h"
#include "apps/experiment/subject.h"

namespace presa {
namespace {

using namespace experiment;

struct ValidateArguments {
  std::string data, key;
};

/// Checks the signature of a valid session and prints the result; false when the key disproves it.
bool signatureGood(const SessionFolder& folder, const Verdict& verdict, const std::string& key) {
  const bool is_signed = std::filesystem::exists(folder.file(kSignatureFile));
  if (key.empty()) {
    std::printf("  seal %s%s\n", verdict.seal.c_str(), is_signed ? ", signed: --key PUBLIC_KEY checks it" : "");
    return true;
  }
  const auto trouble = signatureTrouble(folder, verdict.seal, key);
  std::printf("  seal %s, %s\n", verdict.seal.c_str(),
              trouble ? ("NOT PROVEN: " + *trouble).c_str() : "signed by the key");
  return !trouble;
}

int validateAll(const ValidateArguments& a) {
  const std::string& data = a.data;
  const std::vector<SessionFolder> sessions = sessionsIn(data);
  if (sessions.empty()) {
    std::fprintf(stderr, "%s: holds no session\n", data.c_str());
    return kExitBadInput;
  }
  bool good = true;
  for (const SessionFolder& folder : sessions) {
    const Verdict verdict = validate(folder);
    good = good && verdict.findings.empty();
    const char* const word = verdict.altered            ? "ALTERED"
                             : verdict.findings.empty() ? "complete and unaltered"
                                                        : "unaltered, NOT in order";
    std::printf("%s: %s (%zu trials that count, %zu runs)\n", folder.path.c_str(), word, verdict.trials, verdict.runs);
    for (const std::string& finding : verdict.findings) std::printf("  %s\n", finding.c_str());
    for (const std::string& note : verdict.notes) std::printf("  %s\n", note.c_str());
    if (verdict.findings.empty()) good = signatureGood(folder, verdict, a.key) && good;
  }
  return good ? kExitOk : kExitFault;
}

struct SignArguments {
  std::string data, key;
};

int signAll(const SignArguments& a) {
  const std::vector<SessionFolder> sessions = sessionsIn(a.data);
  if (sessions.empty()) {
    std::fprintf(stderr, "%s: holds no session\n", a.data.c_str());
    return kExitBadInput;
  }
  bool all = true;
  for (const SessionFolder& folder : sessions) {
    const Verdict verdict = validate(folder);
    if (verdict.findings.empty()) {
      signSeal(folder, verdict.seal, a.key);
      std::printf("%s: signed, seal %s\n", folder.path.c_str(), verdict.seal.c_str());
    } else {
      all = false;
      std::printf("%s: NOT signed: %s\n", folder.path.c_str(), verdict.findings.front().c_str());
    }
  }
  return all ? kExitOk : kExitFault;
}

void addValidate(Command app, int& status) {
  auto a = std::make_shared<ValidateArguments>();
  Command command = app.command("validate", "Prove that a dataset is complete and unaltered");
  addFolder(command, a->data);
  command.option("--key", a->key, "public key of the laboratory: every session must be signed by it");
  command.footer(
      "Without --key this detects accidents, not malice: a person who alters a session on purpose can recompute its "
      "checksums.");
  command.action([a, &status] { status = validateAll(*a); });
}

void addSign(Command app, int& status) {
  auto a = std::make_shared<SignArguments>();
  Command command = app.command("sign", "Sign the seal of every finished session with the laboratory's key");
  addFolder(command, a->data);
  command.option("--key", a->key, "secret key, made by presa experiment key").required();
  command.footer("Exit status: 0 all signed, 1 a session is not in order and was not signed, 2 bad input.");
  command.action([a, &status] { status = signAll(*a); });
}

void addKey(Command app) {
  auto file = std::make_shared<std::string>();
  Command command = app.command("key", "Make the laboratory's key: FILE, to be kept secret, and FILE.pub");
  command.option("FILE", *file, "file for the secret key; nothing is overwritten").required();
  command.action([file] {
    makeKeyFiles(*file);
    std::printf("%s is secret: keep it away from the data\n%s.pub is for everybody who checks the data\n",
                file->c_str(), file->c_str());
  });
}

struct ForgetArguments {
  std::string subject, data = ".";
  bool yes = false;
};

/// Asks for confirmation on a terminal; without a terminal --yes is required.
bool confirmed(const ForgetArguments& a) {
  if (a.yes) return true;
  if (::isatty(STDIN_FILENO) == 0) {
    std::fputs("nothing was removed: this cannot be undone, add --yes\n", stderr);
    return false;
  }
  std::printf("This cannot be undone. Type %s to remove all of it: ", a.subject.c_str());
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  return answer == a.subject;
}

int forgetSubject(const ForgetArguments& a) {
  Diagnostics diagnostics;
  subjectOf(a.subject, 1, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;
  const Traces traces = tracesOf(a.data, a.subject);
  if (traces.empty()) {
    std::printf("%s holds nothing of %s\n", a.data.c_str(), a.subject.c_str());
    return kExitOk;
  }
  const auto list = [](const std::vector<std::string>& paths, const char* what) {
    for (const std::string& path : paths) std::printf("  %s%s\n", path.c_str(), what);
  };
  list(traces.folders, "/");
  list(traces.files, "");
  list(traces.links, ": the link, not what it points to");
  list(traces.tables, ": rows of the subject");
  if (!confirmed(a)) return kExitBadInput;
  forget(traces, a.subject);
  std::printf("removed: %zu folders with %zu files, %zu files, %zu links, rows in %zu tables\n", traces.folders.size(),
              traces.files_in_folders, traces.files.size(), traces.links.size(), traces.tables.size());
  if (!traces.mentions.empty()) std::puts("not changed, but they name the subject; regenerate or remove them:");
  list(traces.mentions, "");
  return kExitOk;
}

void addForget(Command app, int& status) {
  auto a = std::make_shared<ForgetArguments>();
  Command command = app.command("forget", "Remove a subject from a dataset for good, and say what was removed");
  command.option("--subject", a->subject, "pseudonym").required();
  command.option("--data", a->data, "folder of the dataset, exports below it included").existingFolder().showDefault();
  command.flag("--yes", a->yes, "do not ask");
  command.footer("Exit status: 0 removed or nothing there, 2 not confirmed.");
  command.action([a, &status] { status = forgetSubject(*a); });
}

}  // namespace

void addDatasetCommands(Command app, int& status) {
  addValidate(app, status);
  addKey(app);
  addSign(app, status);
  addForget(app, status);
}

}  // namespace presa
