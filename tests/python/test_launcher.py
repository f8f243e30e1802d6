"""The launcher in a folder of its own, where every tool that it calls is a
stand-in that notes its call: what is installed, built and run, and how."""

import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# All that the launcher may use of a bare system.
BASIC_TOOLS = ("awk bash cat cut dirname env grep head lscpu mktemp nproc readlink rm sed sleep "
               "sort tail wc touch").split()

STAND_IN = '#!/bin/bash\necho "${0##*/} $*" >> "$CALLS"\n'
BINARY = STAND_IN + """printf '<%s>' "$@" >> "$CALLS"; echo >> "$CALLS"
case "$*" in
  *wait*)
    trap 'echo "checkpoint" >> "$CALLS"; exit 3' USR1
    touch "$CALLS.ready"
    while true; do sleep 0.05; done ;;
  *code*) exit "${2#code}" ;;
esac
"""
MPIRUN = STAND_IN + 'shift 3\nexec "$@"\n'
APT = STAND_IN + """[ "$1" = install ] || exit 0
shift 3
for package in "$@"; do printf "ii %s " "$package" >> "$INSTALLED"; done
"""
DPKG_QUERY = '#!/bin/bash\ncat "$INSTALLED"\n'
CMAKE = STAND_IN + """case "$*" in
  *--build*) ;;
  *)
    echo "CMAKE_HOME_DIRECTORY:INTERNAL=$2" > "$4/CMakeCache.txt"
    touch "$4/Makefile" ;;
esac
"""


class Launcher(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(os.path.realpath(holder.name))
        self.tools = self.folder / "bin"
        self.tools.mkdir()
        shutil.copy(ROOT / "ephyra", self.folder)
        for tool in BASIC_TOOLS:
            (self.tools / tool).symlink_to(shutil.which(tool))
        self.calls = self.folder / "calls"
        self.installed = self.folder / "installed"
        self.installed.touch()
        (self.folder / "build").mkdir()
        self.script(self.folder / "build" / "ephyra-binary", BINARY)
        for name, text in (("cmake", CMAKE), ("mpirun", MPIRUN), ("apt-get", APT),
                           ("dpkg-query", DPKG_QUERY), ("id", "#!/bin/bash\necho 0\n")):
            self.script(self.tools / name, text)
        self.environment = {"PATH": str(self.tools), "CALLS": str(self.calls),
                            "INSTALLED": str(self.installed), "HOME": str(self.folder)}

    def script(self, path, text):
        path.write_text(text)
        path.chmod(0o755)

    def command(self, *arguments):
        return [str(self.folder / "ephyra"), *arguments]

    def run_launcher(self, *arguments, **environment):
        self.calls.write_text("")
        result = subprocess.run(self.command(*arguments), env={**self.environment, **environment},
                                capture_output=True, text=True, timeout=60)
        return result.returncode, result.stderr, self.calls.read_text()

    def test_first_call_installs_configures_builds_and_runs(self):
        code, screen, calls = self.run_launcher("run", "a.prm", "-n", "1")
        self.assertEqual(code, 0, screen)
        order = [line.split()[0] for line in calls.splitlines() if line[0] != "<"]
        self.assertEqual(order, ["apt-get", "apt-get", "cmake", "cmake", "ephyra-binary"])
        self.assertIn("installing git cmake", screen)
        self.assertIn("--no-install-recommends", calls)
        self.assertIn("-DCMAKE_BUILD_TYPE=Release", calls)

    def test_second_call_only_builds_and_runs(self):
        self.run_launcher("build")
        code, screen, calls = self.run_launcher("run", "a.prm", "-n", "1")
        self.assertEqual((code, screen), (0, ""))
        order = [line.split()[0] for line in calls.splitlines() if line[0] != "<"]
        self.assertEqual(order, ["cmake", "ephyra-binary"])

    def test_sudo_where_not_root(self):
        self.script(self.tools / "id", "#!/bin/bash\necho 1000\n")
        self.script(self.tools / "sudo", STAND_IN + 'exec "$@"\n')
        code, screen, calls = self.run_launcher("build")
        self.assertEqual(code, 0, screen)
        self.assertIn("sudo env DEBIAN_FRONTEND=noninteractive apt-get install", calls)
        self.assertIn("by: sudo apt-get install", screen)

    def test_remedy_without_sudo_and_without_apt(self):
        self.script(self.tools / "id", "#!/bin/bash\necho 1000\n")
        code, screen, calls = self.run_launcher("build")
        self.assertEqual((code, calls), (1, ""))
        self.assertIn("as root", screen)
        (self.tools / "apt-get").unlink()
        code, screen, _ = self.run_launcher("build")
        self.assertEqual(code, 1)
        self.assertIn("apt-get was not found", screen)
        self.assertIn("docs/manual/cluster.md", screen)

    def test_cluster_installs_nothing(self):
        (self.tools / "apt-get").unlink()
        code, _, calls = self.run_launcher("build", Trilinos_DIR="/opt/trilinos")
        self.assertEqual(code, 0)
        self.assertIn("-DTrilinos_DIR=/opt/trilinos", calls)

    def test_build_of_another_clone_is_configured_anew(self):
        self.run_launcher("build")
        cache = self.folder / "build" / "CMakeCache.txt"
        cache.write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere\n")
        _, screen, _ = self.run_launcher("build")
        self.assertIn("was configured for /elsewhere", screen)
        self.assertIn(str(self.folder), cache.read_text())

    def test_arguments_and_exit_codes_are_handed_on(self):
        assignment = "Fluid/Inflow = sin(2*pi*t) * \"x\""
        _, _, calls = self.run_launcher("run", "a b.prm", "-n1", "--set", assignment)
        self.assertIn(f"<a b.prm><--set><{assignment}>", calls)
        for ranks in ("1", "2"):
            for expected in (0, 1, 2, 3):
                code, _, _ = self.run_launcher("run", "a.prm", f"code{expected}", "-n", ranks)
                self.assertEqual(code, expected)

    def test_ranks(self):
        _, _, calls = self.run_launcher("run", "a.prm", "-n", "3")
        self.assertIn(f"mpirun -q -n 3 {self.folder}/build/ephyra-binary a.prm", calls)
        _, screen, _ = self.run_launcher("run", "a.prm")
        self.assertRegex(screen, r"running on [1-4] MPI rank\(s\)")
        code, screen, _ = self.run_launcher("run", "a.prm", "-n", "two")
        self.assertEqual(code, 1)
        self.assertIn("-n two is not a number of ranks", screen)

    def test_other_commands(self):
        for arguments, expected in ((["validate", "a.prm", "b.prm"], "<--validate><a.prm><b.prm>"),
                                    (["parameters"], "<--parameters>"),
                                    (["parameters", "--markdown"], "<--parameters=markdown>"),
                                    (["bench"], "<--bench>")):
            code, _, calls = self.run_launcher(*arguments)
            self.assertEqual(code, 0)
            self.assertIn(expected, calls)
        code, screen, _ = self.run_launcher("swim")
        self.assertEqual(code, 1)
        self.assertIn("unknown command 'swim'", screen)
        help_text = subprocess.run(self.command("--help"), env=self.environment,
                                   capture_output=True, text=True, check=True).stdout
        for word in ("run", "test", "build", "validate", "parameters", "sweep",
                     "calibrate", "bench", "-n RANKS", "--set"):
            self.assertIn(word, help_text)

    def interrupt(self, number, ranks):
        self.run_launcher("build")
        process = subprocess.Popen(self.command("run", "wait", "-n", ranks), env=self.environment,
                                   stderr=subprocess.PIPE, text=True)
        ready = self.calls.with_name("calls.ready")
        deadline = time.monotonic() + 30
        while not ready.exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(number)
        _, screen = process.communicate(timeout=30)
        return process.returncode, screen

    def test_signals_become_a_checkpoint(self):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1):
            for ranks in ("1", "2"):
                code, _ = self.interrupt(number, ranks)
                self.assertEqual(code, 3)
                self.assertIn("checkpoint", self.calls.read_text())
                self.calls.with_name("calls.ready").unlink()


if __name__ == "__main__":
    unittest.main()
