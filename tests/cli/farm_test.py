"""Frames and parts of pictures on many machines: the same names and bits as a single run, whatever is killed; merge
refuses what does not belong together. With Slurm (slurm-wlm, as root) the printed scripts run on two nodes of this machine."""

import os
import random
import shlex
import shutil
import signal
import socket
import subprocess
import time
import unittest

from program import DONE, FILE_ERROR, INTERRUPTED, LEKALO, ProgramTest, USAGE

SCENE = """lekalo: 1
parameters: { r: 0.4 }
geometry: { ring: { type: torus_body, major_radius: 1, minor_radius: r } }
camera: { type: perspective, from: [0, -5, 3], at: [0, 0, 0] }
image: { size: [120, 80], samples: 4 }
"""


class Farm(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("ring.yaml", SCENE)

    def part(self, i, n, *options, code=DONE):
        return self.run_program("render", "ring.yaml", "-o", "ring.png", "-o", "ring.exr", "--tile", f"{i}/{n}", *options, code=code)[1]

    def single(self):
        self.run_program("render", "ring.yaml", "-o", "whole.png", "-o", "whole.exr", "--quiet")

    def test_parts_make_the_whole(self):
        self.single()
        for i in 3, 1, 2:
            self.assertTrue(self.part(i, 3).endswith(f"ring.png.{i}of3.partial\n"))
        self.assertFalse((self.folder / "ring.png").exists())
        parts = sorted(path.name for path in self.folder.glob("*.partial"))
        self.run_program("merge", *parts)
        for kind in "png", "exr":
            self.assertEqual(self.bytes_of(f"ring.{kind}"), self.bytes_of(f"whole.{kind}"))
        # Elsewhere, under another name.
        (self.folder / "moved").mkdir()
        shutil.move(self.folder / "ring.yaml", self.folder / "moved/ring.yaml")
        self.run_program("merge", *parts, "--scene", "moved/ring.yaml", "-o", "other.exr")
        self.assertEqual(self.bytes_of("other.exr"), self.bytes_of("whole.exr"))

    def test_merge_refuses(self):
        for i in 1, 2, 4:
            self.part(i, 4)
        parts = [f"ring.png.{i}of4.partial" for i in (1, 2, 4)]
        self.assertIn("missing are the parts 3/4", self.run_program("merge", *parts, code=USAGE)[1])
        self.part(3, 5)
        self.assertIn("one of 4 parts", self.run_program("merge", *parts, "ring.png.3of5.partial", code=USAGE)[1])
        self.assertIn("are the same part", self.run_program("merge", *parts, parts[0], code=USAGE)[1])
        self.part(3, 4, "--set", "r=0.3")
        self.assertIn("parts of different pictures", self.run_program("merge", *parts, "ring.png.3of4.partial", code=USAGE)[1])
        self.part(3, 4, "--samples", "9")
        self.assertIn("parts of different pictures", self.run_program("merge", *parts, "ring.png.3of4.partial", code=USAGE)[1])
        self.write("song.partial", "half of a song")
        for file in "song.partial", "lacking.partial":
            said = self.run_program("merge", file, code=USAGE)[1]
            self.assertIn(file, said)
            self.assertIn("render --tile", said)
        self.part(3, 4)
        self.write("ring.yaml", SCENE + "# changed\n")
        self.assertIn("another scene", self.run_program("merge", *parts, "ring.png.3of4.partial", code=FILE_ERROR)[1])
        for wrong in "0/4", "5/4", "1", "a/b", "1/4/2":
            self.assertIn("--tile takes", self.run_program("render", "ring.yaml", "--tile", wrong, code=USAGE)[1])

    def test_drawings_have_no_parts(self):
        self.write("drawn.yaml", SCENE + "outputs: d.svg\n")
        self.assertIn("are drawings", self.run_program("make", "drawn.yaml", "--tile", "1/2", code=USAGE)[1])

    def test_only_some_frames(self):
        frames = ["render", "ring.yaml", "--size", "24x16", "--quiet", "--frames", "r=0.1..0.5:12"]
        self.run_program(*frames, "-o", "all.png")
        self.run_program(*frames, "-o", "some.png", "--only", "9-11,2")
        found = sorted(path.name for path in self.folder.glob("some*.png"))
        self.assertEqual(found, ["some_0002.png", "some_0009.png", "some_0010.png", "some_0011.png"])
        for name in found:
            self.assertEqual(self.bytes_of(name), self.bytes_of(name.replace("some", "all")))
        before = (self.folder / "some_0009.png").stat().st_mtime_ns
        _, said = self.run_program(*[word for word in frames if word != "--quiet"], "-o", "some.png", "--skip-existing", "--progress")
        self.assertIn("some_0009.png: is there already", said)
        self.assertIn("progress 100.0% some_0012.png\n", said)
        self.assertEqual((self.folder / "some_0009.png").stat().st_mtime_ns, before)
        self.assertEqual(len(list(self.folder.glob("some*.png"))), 12)
        for wrong in "0", "13", "3-2", "a", "1,", "2-":
            self.assertIn("--only", self.run_program(*frames, "--only", wrong, code=USAGE)[1])
        self.assertIn("--only", self.run_program("render", "ring.yaml", "--only", "1", code=USAGE)[1])

    def test_killing_loses_nothing(self):
        """At ten random moments, by SIGTERM and SIGKILL: the same command again goes on, and the bits are those of one run."""
        self.write("ring.yaml", SCENE.replace("samples: 4", "samples: 400"))
        self.single()
        random_numbers = random.Random(5)
        kills = 0
        for i in 1, 2, 3:
            command = [LEKALO, "render", "ring.yaml", "-o", "ring.png", "-o", "ring.exr", "--tile", f"{i}/3", "--skip-existing", "--quiet"]
            for _ in range(40):
                run = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.DEVNULL)
                try:
                    code = run.wait(timeout=random_numbers.uniform(0.02, 0.3) if kills < 10 else 120)
                except subprocess.TimeoutExpired:
                    run.send_signal(random_numbers.choice([signal.SIGTERM, signal.SIGKILL]))
                    kills += 1
                    self.assertIn(run.wait(), [INTERRUPTED, DONE, -signal.SIGTERM, -signal.SIGKILL])
                    continue
                self.assertEqual(code, DONE)
                break
        self.run_program("merge", *(f"ring.png.{i}of3.partial" for i in (1, 2, 3)))
        for kind in "png", "exr":
            self.assertEqual(self.bytes_of(f"ring.{kind}"), self.bytes_of(f"whole.{kind}"))

    def test_begun_by_another_version(self):
        """What cannot be gone on with is made anew."""
        self.write("ring.png.partial", "lekalo partial 1\n...")
        self.write("ring.png", "half a picture")
        self.run_program("render", "ring.yaml", "-o", "ring.png", "--skip-existing", "--quiet")
        self.single()
        self.assertEqual(self.bytes_of("ring.png"), self.bytes_of("whole.png"))
        self.assertFalse((self.folder / "ring.png.partial").exists())

    def test_other_settings_are_another_picture(self):
        self.part(1, 2, "--samples", "1")
        for options in (("--samples", "2"), ("--samples", "2", "--size", "60x40"), ("--samples", "2", "--representation", "mesh")):
            self.assertNotIn("is there already", self.part(1, 2, "--skip-existing", *options))
            self.assertIn("is there already", self.part(1, 2, "--skip-existing", *options))
        self.part(2, 2, *options)
        self.run_program("merge", "ring.png.1of2.partial", "ring.png.2of2.partial", "--quiet")

    def test_unfinished_part(self):
        self.write("ring.yaml", SCENE.replace("samples: 4", "samples: 20000"))
        run = subprocess.Popen([LEKALO, "render", "ring.yaml", "-o", "ring.png", "--tile", "1/1"], cwd=self.folder, stderr=subprocess.PIPE)
        time.sleep(2)
        run.send_signal(signal.SIGTERM)
        self.assertIn(b"--resume ring.png.1of1.partial", run.communicate()[1])
        self.assertEqual(run.returncode, INTERRUPTED)
        self.assertIn("is not finished: ", self.run_program("merge", "ring.png.1of1.partial", code=USAGE)[1])
        self.assertFalse((self.folder / "ring.png").exists())

    def test_lists(self):
        out, _ = self.run_program("farm", "list", "ring.yaml", "--frames", "r=0.1..0.5:3", "-o", "a b.png", "--set", "x=1")
        lines = out.split("\n")[:-1]
        self.assertEqual(shlex.split(lines[1]), ["lekalo", "render", "ring.yaml", "--set", "x=1", "-o", "a b.png", "--frames",
                                                 "r=0.1..0.5:3", "--skip-existing", "--quiet", "--progress", "--only", "2"])
        self.assertEqual(len(lines), 3)
        tiles = ["farm", "list", "ring.yaml", "--tiles", "2", "-o", "ring.png"]
        for line in [*self.run_program(*tiles)[0].split("\n")[:-1], self.run_program(*tiles, "--merge")[0]]:
            self.run_program(*shlex.split(line)[1:])
        self.single()
        self.assertEqual(self.bytes_of("ring.png"), self.bytes_of("whole.png"))
        script, _ = self.run_program("farm", "slurm", "ring.yaml", "--tiles", "8", "-o", "ring.png")
        self.assertIn("--array=1-8 ", script)
        self.assertIn("--dependency=afterok:", script)
        subprocess.run(["sh", "-n"], input=script, text=True, check=True)
        for wrong in (["ring.yaml"], ["ring.yaml", "--tiles", "2"], ["ring.yaml", "--frames", "r=1..2:3", "--merge"]):
            self.run_program("farm", "list", *wrong, code=USAGE)


HAS_SLURM = os.geteuid() == 0 and all(shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin") for name in ("slurmctld", "slurmd", "sbatch"))
CONFIGURATION = """ClusterName=lekalo
SlurmctldHost=localhost
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
CryptoType=crypto/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation={0}/state
SlurmdSpoolDir={0}/spool.%n
SlurmctldPidFile={0}/slurmctld.pid
SlurmdPidFile={0}/slurmd.%n.pid
SlurmctldLogFile={0}/slurmctld.log
SlurmdLogFile={0}/slurmd.%n.log
SlurmctldPort={1}
ReturnToService=2
KillWait=5
MinJobAge=300
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
NodeName=n1 NodeHostname={4} NodeAddr=127.0.0.1 Port={2} CPUs=1
NodeName=n2 NodeHostname={4} NodeAddr=127.0.0.1 Port={3} CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


@unittest.skipUnless(HAS_SLURM, "slurm-wlm is not installed, or this is not root")
class Slurm(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("ring.yaml", SCENE)
        (self.folder / "state").mkdir()
        (self.folder / "bin").mkdir()
        (self.folder / "bin/lekalo").symlink_to(LEKALO)
        self.write("slurm.conf", CONFIGURATION.format(self.folder, free_port(), free_port(), free_port(), socket.gethostname().split(".")[0]))
        self.settings = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf"),
                         "PATH": f"{self.folder}/bin:{os.environ['PATH']}:/usr/sbin:/sbin"}
        self.daemons = []
        self.start("slurmctld", "-D", "-f", str(self.folder / "slurm.conf"))
        for node in "n1", "n2":
            self.start("slurmd", "-D", "-N", node, "-f", str(self.folder / "slurm.conf"))
        self.wait(lambda: self.slurm("sinfo", "-h", "-o", "%T").split() and
                  set(self.slurm("sinfo", "-h", "-N", "-o", "%T").split()) == {"idle"}, 40, "no idle nodes")

    def start(self, *command):
        daemon = subprocess.Popen(command, env=self.settings, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  start_new_session=True)
        self.daemons.append(daemon)
        self.addCleanup(self.stop, daemon)

    def stop(self, daemon):
        daemon.terminate()
        try:
            daemon.wait(timeout=10)
        except subprocess.TimeoutExpired:
            daemon.kill()
            daemon.wait()

    def slurm(self, *command):
        return subprocess.run(command, env=self.settings, cwd=self.folder, capture_output=True, text=True, timeout=60).stdout

    def wait(self, condition, seconds, what):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.3)
        logs = "".join(path.read_text(errors="replace")[-1500:] for path in self.folder.glob("*.log"))
        self.fail(f"{what}\n{logs}\n{self.slurm('squeue')}\n{self.slurm('sinfo')}")

    def submit(self, *options):
        script, _ = self.run_program("farm", "slurm", "ring.yaml", *options)
        done = subprocess.run(["sh"], input=script, env=self.settings, cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.split()

    def queue_is_empty(self):
        return not self.slurm("squeue", "-h").strip()

    def test_frames_and_parts(self):
        self.run_program("render", "ring.yaml", "--quiet", "--size", "24x16", "--frames", "r=0.1..0.5:24", "-o", "single.png")
        self.submit("--frames", "r=0.1..0.5:24", "--size", "24x16", "-o", "frame.png")
        self.wait(self.queue_is_empty, 120, "the frames do not end")
        for k in range(1, 25):
            self.assertEqual(self.bytes_of(f"frame_{k:04}.png"), self.bytes_of(f"single_{k:04}.png"))
        self.write("ring.yaml", SCENE.replace("samples: 4", "samples: 256"))
        self.run_program("render", "ring.yaml", "--quiet", "-o", "whole.exr")
        job, merge = self.submit("--tiles", "8", "-o", "ring.exr")
        # A task is killed on its way and given to the queue again; then all of it is cancelled and submitted anew.
        self.wait(lambda: "R" in self.slurm("squeue", "-h", "-o", "%t").split(), 60, "nothing runs")
        running = self.slurm("squeue", "-h", "-t", "R", "-o", "%A").split()
        if running:
            self.slurm("scontrol", "requeue", running[0])
        self.wait(lambda: list(self.folder.glob("*.partial")) or self.queue_is_empty(), 60, "no part is made")
        self.slurm("scancel", job, merge)
        self.wait(self.queue_is_empty, 60, "the tasks do not end")
        self.submit("--tiles", "8", "-o", "ring.exr")
        self.wait(self.queue_is_empty, 180, "the parts do not end")
        logs = "".join(path.read_text(errors="replace")[-300:] for path in self.folder.glob("slurm-*.out"))
        self.assertTrue((self.folder / "ring.exr").exists(), logs)
        self.assertEqual(self.bytes_of("ring.exr"), self.bytes_of("whole.exr"))


if __name__ == "__main__":
    unittest.main()
