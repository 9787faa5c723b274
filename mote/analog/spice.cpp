#include "mote/analog/spice.hpp"

#include <dlfcn.h>

#if __has_include(<ngspice/sharedspice.h>)
#include <ngspice/sharedspice.h>
#define MOTE_HAS_NGSPICE
#endif

#include "mote/base/refusal.hpp"

namespace mote::analog {
namespace {

constexpr const char* kLibrary = "libngspice.so.0";
constexpr std::size_t kShown = 600;  // characters of what ngspice said when it fails

[[noreturn]] void refuse_missing(const std::string& expected, const std::string& got, const std::string& next) {
  throw Refusal(ExitCode::kOutsideTool, {"ngspice", "", expected, got, next});
}

}  // namespace

Spice& Spice::loaded() {
  static Spice spice(kLibrary);
  return spice;
}

std::string Spice::missing() {
  try {
    loaded();
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

#ifdef MOTE_HAS_NGSPICE

namespace {

/// A function of the library by its name.
template <class Function>
Function* called(void* library, const char* name) {
  void* symbol = dlsym(library, name);
  if (symbol == nullptr) refuse_missing(std::string("a library with ") + name, dlerror(), "Reinstall libngspice0.");
  return reinterpret_cast<Function*>(symbol);
}

}  // namespace

Spice::Spice(const std::string& library) : library_(dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (library_ == nullptr)
    refuse_missing("its shared library", dlerror(), "Install it: apt-get install libngspice0-dev.");
  const auto initialise = called<decltype(ngSpice_Init)>(library_, "ngSpice_Init");
  const auto quiet = [](char*, int, void*) { return 0; };
  initialise(&Spice::heard, quiet, &Spice::ended, nullptr, nullptr, nullptr, this);
}

int Spice::heard(char* text, int, void* self) {
  static_cast<Spice*>(self)->said_ += std::string(text) + "\n";
  return 0;
}

int Spice::ended(int, bool, bool, int, void* self) {
  static_cast<Spice*>(self)->over_ = true;
  return 0;
}

void Spice::fail(const std::string& what) const {
  const std::size_t from = said_.size() - std::min(said_.size(), kShown);
  throw Refusal(ExitCode::kOutsideTool, {"ngspice", what, "a solution", "none", "It said: " + said_.substr(from)});
}

void Spice::command(const std::string& text) {
  said_.clear();
  std::string own = text;  // what the library takes is not const
  const int code = called<decltype(ngSpice_Command)>(library_, "ngSpice_Command")(own.data());
  if (code != 0 || over_) fail(text);
}

void Spice::take(std::vector<std::string> lines) {
  if (taken_) {
    command("destroy all");
    command("remcirc");
  }
  lines.emplace_back(".end");
  std::vector<char*> words;
  for (std::string& line : lines) words.push_back(line.data());
  words.push_back(nullptr);
  said_.clear();
  const int code = called<decltype(ngSpice_Circ)>(library_, "ngSpice_Circ")(words.data());
  if (code != 0 || over_ || said_.find("rror") != std::string::npos) fail("a netlist");
  taken_ = true;
}

void Spice::run(const std::string& text) {
  command("destroy all");
  command(text);
  if (said_.find("aborted") != std::string::npos) fail(text);
}

std::vector<double> Spice::values(const std::string& name) const {
  std::string own = name;
  const vector_info* found = called<decltype(ngGet_Vec_Info)>(library_, "ngGet_Vec_Info")(own.data());
  if (found == nullptr || found->v_realdata == nullptr || found->v_length == 0) fail(name);
  return {found->v_realdata, found->v_realdata + found->v_length};
}

#else

Spice::Spice(const std::string&) {
  refuse_missing("its headers when mote was built", "none", "Install libngspice0-dev and build mote again.");
}
void Spice::take(std::vector<std::string>) {}
void Spice::run(const std::string&) {}
std::vector<double> Spice::values(const std::string&) const { return {}; }

#endif

}  // namespace mote::analog
