// Programs beside ours: what they get, and what is said of those that cannot be started.
#include "base/spawn.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string>

namespace ambf::base {
namespace {

// What a shell script says. Its exit code in `code`.
std::string said_by(const std::string& script, int& code) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  Streams streams;
  streams.output = ends[1];
  std::string problem;
  const pid_t program = spawn({"/bin/sh", "-c", script}, streams, problem);
  close(ends[1]);
  EXPECT_GT(program, 0) << problem;
  std::string said;
  std::array<char, 256> some{};
  for (ssize_t size = 0; (size = read(ends[0], some.data(), some.size())) > 0;)
    said.append(some.data(), static_cast<std::size_t>(size));
  close(ends[0]);
  int status = 0;
  waitpid(program, &status, 0);
  code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return said;
}

TEST(Spawn, StreamsLeadWhereTheyShould) {
  int code = 0;
  EXPECT_EQ(said_by("cat; echo said; echo lost >&2; exit 7", code), "said\n") << "its input is empty";
  EXPECT_EQ(code, 7);
}

TEST(Spawn, AProgramHasASessionOfItsOwn) {
  int code = 0;
  const std::string said = said_by("read _ _ _ _ _ session _ < /proc/self/stat; echo $session $$", code);
  const std::size_t space = said.find(' ');
  ASSERT_NE(space, std::string::npos) << said;
  EXPECT_EQ(said.substr(0, space) + "\n", said.substr(space + 1));
}

// A shell cannot take back what was ignored when it was started: so it is the program's default that ends it.
TEST(Spawn, WhatWeIgnoreOrBlockEndsAProgramAllTheSame) {
  for (const int number : {SIGHUP, SIGINT, SIGTERM, SIGPIPE}) {
    const auto before = signal(number, SIG_IGN);
    sigset_t blocked, was;
    sigemptyset(&blocked);
    sigaddset(&blocked, number);
    pthread_sigmask(SIG_BLOCK, &blocked, &was);
    int code = 0;
    said_by("kill -" + std::to_string(number) + " $$; exit 0", code);
    pthread_sigmask(SIG_SETMASK, &was, nullptr);
    signal(number, before);
    EXPECT_EQ(code, 128 + number);
  }
}

TEST(Spawn, WhatCannotBeStartedIsSaid) {
  std::string problem;
  EXPECT_EQ(spawn({"/nothing/here"}, {}, problem), -1);
  EXPECT_EQ(problem, "cannot start /nothing/here: No such file or directory");
}

TEST(FindProgram, LooksOnThePathOnlyForBareNames) {
  EXPECT_EQ(find_program("/bin/sh"), "/bin/sh");
  EXPECT_EQ(find_program("/bin/no_such_program"), "");
  EXPECT_EQ(find_program("no_such_program_of_ambf"), "");
  const std::string path = getenv("PATH");
  setenv("PATH", "/nowhere::/bin", 1);
  EXPECT_EQ(find_program("sh"), "/bin/sh");
  EXPECT_EQ(places_on_path("sh"), (std::vector<std::string>{"/nowhere/sh", "/bin/sh"}));
  setenv("PATH", "", 1);
  EXPECT_EQ(find_program("sh"), "");
  setenv("PATH", path.c_str(), 1);
}

TEST(FindProgram, PassesOverFoldersAndWhatCannotBeRun) {
  EXPECT_EQ(find_program("/bin"), "");
  EXPECT_EQ(first_program({"/bin", "/etc/passwd", "/bin/cat", "/bin/sh"}), "/bin/cat");
  EXPECT_EQ(first_program({}), "");
}

}  // namespace
}  // namespace ambf::base
