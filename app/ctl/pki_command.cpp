#include <memory>

#include "app/ctl/command.h"
#include "hardware/link/pki/authority.h"
#include "hardware/link/pki/check_key_folder.h"
#include "hardware/link/pki/tls_files.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

struct PkiArguments {
  std::string folder = (ConfigFolder() / "pki").string();
  std::string name;
  std::vector<std::string> addresses;
  int ca_days = kDaysOfCa;
  int days = kDaysOfCertificate;
  bool replace = false;
  std::string keys;
  bool json = false;
};

nlohmann::ordered_json ToJson(const LinkCertificate& certificate) {
  return {{"name", certificate.identity.name},        {"role", ToString(certificate.identity.role)},
          {"addresses", certificate.addresses},       {"serial", certificate.serial},
          {"from", DateText(certificate.from_utc_s)}, {"to", DateText(certificate.to_utc_s)}};
}

/// Which files go to the machine, and where its programs look for them.
struct Delivery {
  std::vector<const char*> files;
  fs::path from;
  LinkRole role;

  std::string To() const { return KeyFolderText(role); }

  std::string Describe(const std::string& name) const {
    std::string text;
    for (const char* file : files) text += fmt::format("\n  {}", (from / file).string());
    const bool head = role == LinkRole::kHead;
    text += fmt::format("\nCopy {} into {} on {} ({} for another folder).",
                        files.size() == 1 ? "it" : "them", To(),
                        head ? "the head " + name : "the machine of " + name,
                        head ? "foresight-head --link-keys DIR" : "--link-keys DIR");
    for (const char* file : files)
      if (std::string_view(file) == kPrivateKeyFile)
        text +=
            " link.key is secret: move it on a medium that nobody else reads, keep it at "
            "permissions 600.";
    return text;
  }

  nlohmann::ordered_json ToJson() const {
    return {{"files", files}, {"from", from.string()}, {"to", To()}};
  }
};

void PrintIssued(const PkiArguments& arguments, const LinkCertificate& certificate,
                 const Delivery& delivery, const char* what) {
  if (arguments.json) {
    PrintJson({{"certificate", ToJson(certificate)}, {"deliver", delivery.ToJson()}});
    return;
  }
  const LinkIdentity& identity = certificate.identity;
  PrintLine(fmt::format("{} {}: {}, until {}{}", ToString(identity.role), identity.name, what,
                        DateText(certificate.to_utc_s), delivery.Describe(identity.name)));
}

Result<ExitCode> Init(const PkiArguments& arguments) {
  FORESIGHT_TRY(const auto ca,
                CertificateAuthority::Create(arguments.folder, arguments.ca_days, UtcSecondsNow()));
  const std::string to = DateText(ca.validity().to_utc_s);
  const std::string due = DateText(ca.revocations().due_utc_s);
  if (arguments.json)
    PrintJson({{"folder", arguments.folder}, {"to", to}, {"revocations_due", due}});
  else
    PrintLine(
        fmt::format("{0}: a new CA, until {1}\nNothing of this folder goes to another machine yet. "
                    "Whoever has {0}/ca.key can make operators: keep the folder on one machine or "
                    "a stick in a safe, and a copy of it.\nNext: foresightctl pki head NAME "
                    "--address HOST; foresightctl pki operator NAME",
                    arguments.folder, to));
  return ExitCode::kDone;
}

Result<ExitCode> Issue(const PkiArguments& arguments, LinkRole role) {
  FORESIGHT_TRY(auto ca, CertificateAuthority::Open(arguments.folder));
  const bool replaces = arguments.replace;
  FORESIGHT_TRY(const LinkCertificate certificate,
                ca.Issue({role, arguments.name}, {arguments.addresses, arguments.days, replaces},
                         UtcSecondsNow()));
  PrintIssued(arguments, certificate,
              {{kCaFile, kRevocationsFile, kCertificateFile, kPrivateKeyFile},
               ca.FolderOf(arguments.name),
               role},
              "a new key and certificate");
  return ExitCode::kDone;
}

Result<ExitCode> Renew(const PkiArguments& arguments) {
  FORESIGHT_TRY(auto ca, CertificateAuthority::Open(arguments.folder));
  FORESIGHT_TRY(const LinkCertificate certificate,
                ca.Renew(arguments.name, {arguments.addresses, arguments.days}, UtcSecondsNow()));
  PrintIssued(arguments, certificate,
              {{kRevocationsFile, kCertificateFile},
               ca.FolderOf(arguments.name),
               certificate.identity.role},
              "a new certificate of the same key");
  return ExitCode::kDone;
}

void PrintNewList(const PkiArguments& arguments, const CertificateAuthority& ca,
                  const std::string& what, int revoked) {
  const fs::path list = ca.folder() / kRevocationsFile;
  const std::string due = DateText(ca.revocations().due_utc_s);
  if (arguments.json) {
    PrintJson({{"revoked", revoked},
               {"number", ca.revocations().number},
               {"revocations", list.string()},
               {"due", due},
               {"to", {KeyFolderText(LinkRole::kHead), KeyFolderText(LinkRole::kOperator)}}});
    return;
  }
  PrintLine(
      fmt::format("{}\n  {}\nCopy it into {} on each head, now: a head that has not got it goes on "
                  "as before, one that has it "
                  "needs no restart. Copy it into {} on the stations. A new one is due by {}.",
                  what, list.string(), KeyFolderText(LinkRole::kHead),
                  KeyFolderText(LinkRole::kOperator), due));
}

Result<ExitCode> Revoke(const PkiArguments& arguments) {
  FORESIGHT_TRY(auto ca, CertificateAuthority::Open(arguments.folder));
  FORESIGHT_TRY(const int revoked, ca.Revoke(arguments.name, UtcSecondsNow()));
  PrintNewList(arguments, ca,
               fmt::format("{}: {} revoked; list {} of revocations", arguments.name,
                           revoked == 1 ? "its certificate is"
                                        : fmt::format("its {} certificates are", revoked),
                           ca.revocations().number),
               revoked);
  return ExitCode::kDone;
}

Result<ExitCode> MakeRevocations(const PkiArguments& arguments) {
  FORESIGHT_TRY(auto ca, CertificateAuthority::Open(arguments.folder));
  FORESIGHT_CHECK(ca.MakeRevocationsAnew(arguments.days, UtcSecondsNow()));
  PrintNewList(arguments, ca, fmt::format("list {} of revocations", ca.revocations().number), 0);
  return ExitCode::kDone;
}

std::string StateOf(const IssuedCertificate& issued, std::int64_t now) {
  if (issued.revoked) return "revoked";
  if (issued.certificate.to_utc_s < now) return "expired";
  return issued.current ? "valid" : "renewed";
}

std::string Describe(const std::vector<IssuedCertificate>& all, std::int64_t now) {
  std::string text =
      fmt::format("{:<20} {:<9} {:<8} {:<11} {}", "name", "role", "state", "until", "addresses");
  for (const IssuedCertificate& issued : all) {
    const LinkCertificate& it = issued.certificate;
    text +=
        fmt::format("\n{:<20} {:<9} {:<8} {:<11} {}", it.identity.name, ToString(it.identity.role),
                    StateOf(issued, now), DateText(it.to_utc_s), fmt::join(it.addresses, " "));
    while (text.back() == ' ') text.pop_back();
  }
  return text;
}

Result<ExitCode> List(const PkiArguments& arguments) {
  FORESIGHT_TRY(const auto ca, CertificateAuthority::Open(arguments.folder));
  FORESIGHT_TRY(const auto all, ca.List());
  const std::int64_t now = UtcSecondsNow();
  const bool overdue = ca.revocations().due_utc_s < now;
  if (arguments.json) {
    auto certificates = nlohmann::ordered_json::array();
    for (const IssuedCertificate& issued : all) {
      certificates.push_back(ToJson(issued.certificate));
      certificates.back()["state"] = StateOf(issued, now);
    }
    PrintJson({{"folder", arguments.folder},
               {"to", DateText(ca.validity().to_utc_s)},
               {"revocations",
                {{"number", ca.revocations().number},
                 {"due", DateText(ca.revocations().due_utc_s)},
                 {"overdue", overdue}}},
               {"certificates", certificates}});
    return ExitCode::kDone;
  }
  PrintLine(fmt::format(
      "CA {}, until {}\nlist {} of revocations, {} by {}\n{}", arguments.folder,
      DateText(ca.validity().to_utc_s), ca.revocations().number,
      overdue ? "OVERDUE: foresightctl pki revocations was to be run" : "a new one is due",
      DateText(ca.revocations().due_utc_s), Describe(all, now)));
  return ExitCode::kDone;
}

const char* NameOf(KeyFinding::Kind kind) {
  switch (kind) {
    case KeyFinding::Kind::kGood:
      return "good";
    case KeyFinding::Kind::kWarning:
      return "warning";
    case KeyFinding::Kind::kProblem:
      break;
  }
  return "problem";
}

Result<ExitCode> Check(const PkiArguments& arguments) {
  FORESIGHT_TRY(const KeyFolderReport report, CheckKeyFolder(arguments.keys, UtcSecondsNow()));
  if (arguments.json) {
    auto findings = nlohmann::ordered_json::array();
    for (const KeyFinding& finding : report.findings)
      findings.push_back({{"kind", NameOf(finding.kind)}, {"text", finding.text}});
    PrintJson({{"usable", report.IsUsable()},
               {"certificate",
                report.certificate ? ToJson(*report.certificate) : nlohmann::ordered_json(nullptr)},
               {"findings", findings}});
  } else {
    for (const KeyFinding& finding : report.findings)
      PrintLine(fmt::format("{:<8} {}", NameOf(finding.kind), finding.text));
  }
  if (report.IsUsable()) return ExitCode::kDone;
  PrintNote("foresightctl: {}: these keys cannot be used", arguments.keys);
  return ExitCode::kNegative;
}

using Arguments = std::shared_ptr<PkiArguments>;

template <class Action>
CLI::App* AddAction(CLI::App& pki, Invocation& invocation, const Arguments& arguments,
                    const char* name, const char* help, Action action) {
  CLI::App* command = pki.add_subcommand(name, help);
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments, action] {
    invocation = [arguments, action](const RunContext&) { return action(*arguments); };
  });
  return command;
}

void AddFolder(CLI::App* command, const Arguments& arguments) {
  AddOption(*command, "--pki", arguments->folder, "The CA's folder");
}

CLI::App* AddNamed(CLI::App* command, const Arguments& arguments) {
  AddFolder(command, arguments);
  command->add_option("name", arguments->name, "Of a head, operator or observer")->required();
  return command;
}

void AddDays(CLI::App* command, int& days) {
  AddOption(*command, "--days", days, "How long it is valid");
}

CLI::App* AddIssue(CLI::App& pki, Invocation& invocation, const Arguments& arguments, LinkRole role,
                   const char* help) {
  CLI::App* command =
      AddNamed(AddAction(pki, invocation, arguments, ToString(role).c_str(), help,
                         [role](const PkiArguments& it) { return Issue(it, role); }),
               arguments);
  AddDays(command, arguments->days);
  command->add_flag("--replace", arguments->replace,
                    "Where the name is taken: revoke that certificate and make a new key");
  return command;
}

}  // namespace

void AddPkiCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<PkiArguments>();
  CLI::App* pki = app.add_subcommand("pki", "Keys and certificates of the link to a head");
  pki->require_subcommand(1);
  CLI::App* init =
      AddAction(*pki, invocation, arguments, "init", "Make a private CA, once for all heads", Init);
  AddFolder(init, arguments);
  AddDays(init, arguments->ca_days);
  constexpr const char* kAddress = "Host names and IP addresses at which stations reach the head";
  AddIssue(*pki, invocation, arguments, LinkRole::kHead, "Make the keys of a head")
      ->add_option("--address", arguments->addresses, kAddress)
      ->required();
  AddIssue(*pki, invocation, arguments, LinkRole::kOperator,
           "Make the keys of a person who may drive heads");
  AddIssue(*pki, invocation, arguments, LinkRole::kObserver,
           "Make the keys of a person who may only watch");
  CLI::App* renew = AddNamed(
      AddAction(*pki, invocation, arguments, "renew",
                "A new certificate of the same key, before the old one ends or where a head has "
                "new addresses",
                Renew),
      arguments);
  AddDays(renew, arguments->days);
  renew->add_option("--address", arguments->addresses,
                    "Of a head, instead of the addresses before");
  AddNamed(AddAction(*pki, invocation, arguments, "revoke",
                     "Take the certificates of a name back: keys that were lost, people who left",
                     Revoke),
           arguments);
  CLI::App* revocations =
      AddAction(*pki, invocation, arguments, "revocations",
                "Make the list of revocations anew, before it is overdue", MakeRevocations);
  AddFolder(revocations, arguments);
  AddDays(revocations, arguments->days);
  AddFolder(AddAction(*pki, invocation, arguments, "list",
                      "Which certificates there are, and what ends when", List),
            arguments);
  AddAction(*pki, invocation, arguments, "check",
            "Whether programs can use a folder of keys; exit code 1 where they cannot", Check)
      ->add_option("folder", arguments->keys, "The folder, e.g. /etc/foresight/link")
      ->required();
}

}  // namespace foresight
