#include <cstdio>
#include <new>

#include <fmt/format.h>

#include "mote/app/commands/run.hpp"
#include "mote/cluster/mpi_team.hpp"

namespace {

using namespace mote;

/// What stops one rank alone leaves the others waiting: it ends them all.
[[noreturn]] void end_all(const Team& team, int code, const std::string& sentence) {
  fmt::print(stderr, "rank {} of {}: {}\n", team.rank(), team.ranks(), sentence);
  MpiSession::abort(code);
}

ExitCode run_on_rank(const Arguments& arguments, Team& team) {
  try {
    return run_in_team(arguments, team);
  } catch (const CommonRefusal&) {
    throw;
  } catch (const Refusal& refusal) {
    end_all(team, static_cast<int>(refusal.code()), refusal.what());
  } catch (const std::bad_alloc&) {
    end_all(team, static_cast<int>(ExitCode::kWrongUse),
            arguments.where() + ": the memory did not suffice. Pass fewer --particles, or start more ranks.");
  } catch (const std::exception& error) {
    end_all(team, 1, arguments.where() + ": a fault of mote itself: " + error.what() + ". Please report it.");
  }
}

}  // namespace

int main(int count, char** words) {
  const MpiSession session(count, words);
  const auto team = make_mpi_team();
  return run_program(count, words,
                     {run_command([&](const Arguments& arguments) { return run_on_rank(arguments, *team); })},
                     [] { return true; });  // a common refusal has a sentence on one rank only
}
