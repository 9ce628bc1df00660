"""What scripts/measure measures, and the tables it writes of it into README.md and docs/**/*.md.

A part is one command, run once; its figures are taken from what it prints. A row of a table names figures in braces.
"""
import json
import math
import re
from dataclasses import dataclass, field


class Output:
    """What one command printed, and what it took."""

    def __init__(self, text, wall_s, cpu_s, peak_mb):
        self.text, self.wall_s, self.cpu_s, self.peak_mb = text, wall_s, cpu_s, peak_mb

    def json(self):
        return json.JSONDecoder().raw_decode(self.text, self.text.index("{"))[0]

    def benchmark(self, name):
        for each in self.json()["benchmarks"]:
            if re.sub(r"/(iterations:\d+|min_time:[\d.]+|manual_time|real_time|process_time)", "",
                      each["name"]) == name:
                if each.get("error_occurred"):
                    raise ValueError(f"{name}: {each['error_message']}")
                return each
        raise ValueError(f"no benchmark {name} in the output")


SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


# How a figure is taken from an Output.
def cpu(name):
    return lambda out: (lambda b: b["cpu_time"] * SECONDS[b["time_unit"]])(out.benchmark(name))


def wall(name):
    return lambda out: (lambda b: b["real_time"] * SECONDS[b["time_unit"]])(out.benchmark(name))


def counter(name, key, factor=1.0):
    return lambda out: out.benchmark(name)[key] * factor


def at(*path):
    def take(out):
        value = out.json()
        for key in path:
            value = value[key]
        return value
    return take


def number(pattern, factor=1.0):
    """The first group of the first match, as a number."""
    def take(out):
        match = re.search(pattern, out.text)
        if not match:
            raise ValueError(f"nothing in the output matches {pattern}")
        return float(match[1].replace(",", "")) * factor
    return take


def sum_of(pattern, matches=None):
    """The sum of all first groups; of as many matches as are expected, where that is known."""
    def take(out):
        found = re.findall(pattern, out.text)
        if not found or matches not in (None, len(found)):
            raise ValueError(f"{len(found)} places in the output match {pattern}")
        return sum(float(each) for each in found)
    return take


def stops(name, key):
    """A figure of the line `measured {..}` that a test prints (tests/testing/punctuality.h)."""
    def take(out):
        for line in re.findall(r"^measured (\{.*\})$", out.text, re.M):
            if json.loads(line)["name"] == name:
                return json.loads(line)[key]
        raise ValueError(f"no line `measured` of {name}")
    return take


def processor_s(out):
    return out.cpu_s


def wall_s(out):
    return out.wall_s


def peak_mb(out):
    return out.peak_mb


def digits(value):
    """Below 10 two figures that count; from 10 on one behind the point, where the number isn't whole; from 100 on
    whole numbers."""
    size = abs(value)
    if size >= 10:
        return f"{value:,.0f}" if size >= 100 or value == int(value) else f"{value:.1f}"
    for places in range(1, 9):
        if size >= 10.0 ** (1 - places):
            return f"{value:.{places}f}"
    return "0"


# How a figure is written.
def in_unit(unit):
    def write(value):
        return f"{digits(value / SECONDS[unit])} {unit}"
    return write


US, MS, S, NS = in_unit("us"), in_unit("ms"), in_unit("s"), in_unit("ns")


def fixed(places, unit=""):
    return lambda value: f"{value:,.{places}f}{unit and ' ' + unit}"


def share(places):
    """.991"""
    return lambda value: f"{value:.{places}f}".removeprefix("0")


COUNT = fixed(0)
PERCENT = fixed(1, "%")
MEGABYTES = fixed(0, "MB")
TIMES = fixed(2)


@dataclass
class Part:
    name: str
    seconds: int  # about, on an idle machine with 2 cores
    command: str
    figures: dict  # name -> (take, write)
    idle: bool = True  # its figures are times: of an idle machine only
    env: dict = field(default_factory=dict)
    recordings: bool = False  # wants the real recordings
    show: str = ""  # as a page shows the command, where that is not the command itself
    # Of an Output: "date" and "commit" of the measurement, as far as the command reports an earlier one.
    origin: object = lambda out: {}

    def shown(self):
        text = self.show or self.command
        text = text.replace('xvfb-run -a -s "-screen 0 1600x1000x24" ', "xvfb-run -a ").replace(" --benchmark_format=json", "")
        for name, word in WORDS.items():
            text = text.replace(f'"${name}"', word)
        variables = "".join(f"{key}={value} " for key, value in self.env.items())
        return f"`{variables}{text}`".replace("|", "\\|")


WORDS = {"BENCH": "palpate_benchmarks", "PALPATE": "palpate", "TESTS": "build/release/tests",
         "RECORDINGS": "FOLDER"}


def bench(name, seconds, pattern, figures, display=False, **more):
    screen = 'xvfb-run -a -s "-screen 0 1600x1000x24" ' if display else ""
    quoted = pattern if re.fullmatch(r"[\w/]+", pattern) else f"'{pattern}'"
    return Part(name, seconds,
                f'{screen}"$BENCH" ' f"--benchmark_filter={quoted} --benchmark_format=json",
                figures, **more)


def slow_test(name, seconds, module, file, figures, **more):
    return Part(name, seconds, f'"$TESTS"/{module}/{module}_tests --file={file}', figures, **more)


METHODS = ["centroid", "alcazar", "ncc-paraboloid", "ncc-gauss3", "phase", "phase-normalized",
           "register", "contest"]
PIPELINES = {  # rows of the table of recognition.md
    "diameter-svm": ("diameter", "svm", "--set diameter --classifier svm"),
    "first4-svm": ("first4", "svm", "--set first4 --classifier svm"),
    "moments-svm": ("moments", "svm", "--set moments --classifier svm"),
    "study-svm": ("study", "svm", "--set study --classifier svm"),
    "study-lda-svm": ("study", "LDA(14) + svm", "--set study --lda 14 --classifier svm"),
    "study-lw-svm": ("study", "LDA(14, Ledoit-Wolf) + svm",
                     "--set study --lda 14 --shrinkage auto --classifier svm"),
    "study-lda-qda": ("study", "LDA(14) + qda", "--set study --lda 14 --classifier qda"),
    "best-gauss": ("best", "gauss (default)", "--set best"),
    "best-lda-svm": ("best", "LDA(11) + svm", "--set best --lda 11 --classifier svm"),
    "best-lda-qda": ("best", "LDA(8) + qda", "--set best --lda 8 --classifier qda"),
    "session-lda-svm": ("session", "LDA(14) + svm", "--set session --lda 14 --classifier svm"),
    "session-lda-qda": ("session", "LDA(14) + qda", "--set session --lda 14 --classifier qda"),
}
# Mean of 50 splits with scikit-learn on the same grasps, from the literature of the project: not measured by Palpate.
SCIKIT = {"diameter-svm": ".719", "first4-svm": ".859", "moments-svm": ".694", "study-svm": ".869",
          "study-lda-svm": ".971"}


ALARMS = {"centroid-step": "centroid, > 0.20 per frame", "centroid-windows": "centroid, windows",
          "register-windows": "registration, windows", "contest": "**contest**",
          "contest-joints": "contest, told of joints", "contest-held-out": "contest, held out"}


def in_two(value):
    return f"{value:.0f}" if value >= 10 else f"{value:.1f}"


VALUE_FILTERS = {"mean": "runningMean", "kalman": "kalman", "kalman_smoother": "kalmanSmoother",
                 "kelvin": "kelvinVoigt/whole_ms", "kelvin_any": "kelvinVoigt/any_interval",
                 "em": "estimation/whole_ms", "em_any": "estimation/any_interval"}


def one_value(name):
    return lambda out: 1.0 / out.benchmark(name)["items_per_second"]


def first_time(key):
    """None where the file doesn't have it."""
    def take(out):
        match = re.search(rf"(?m)^{key} (\d+)$", out.text)
        return float(match[1]) if match else None
    return take


def first_time_origin(out):
    """When and of what `scripts/test fresh` wrote the file."""
    return dict(re.findall(r"(?m)^(date|commit) (\S+)$", out.text))


def slip_figures():
    figures = {}
    for method in METHODS:
        for key, places in (("rmse", 4), ("drift_100", 3), ("edge_1_5", 2), ("tilt_40", 3),
                            ("gain_x", 2), ("gain_y", 2), ("rmse_deg", 2)):
            figures[f"{method}.{key}"] = (at("methods", method, key), fixed(places))
        figures[f"{method}.of_bound"] = (
            lambda out, m=method: (lambda j: j["rmse"] / j["crb"])(out.json()["methods"][m]),
            fixed(2))
    figures["bound"] = (at("methods", "register", "crb"), fixed(4))
    return figures


def filter_figures():
    names = ["median", "gaussian", "bilateral", "median3d", "minMedian", "box", "median5x5",
             "opening", "nonLocalMeans", "runningMean", "temporalMin", "kalman", "savitzkyGolay"]
    figures = {name: (cpu(f"filterHand/{name}"), US) for name in names}
    for name in ("median", "gaussian", "bilateral"):
        figures[f"{name}.opencv"] = (cpu(f"filterHandByOpenCv/{name}"), US)
    figures["chain"] = (cpu("defaultChain"), US)
    return figures


def later(name, options):
    return Part(f"another_day_{name}", 2, f"""
mkdir -p later/hockey_ball later/foam_ball later/pen_thick
ln -sf "$RECORDINGS"/grasps/hockey_ball.dsa later/hockey_ball/
ln -sf "$RECORDINGS"/grasps/foam_ball.dsa later/foam_ball/
ln -sf "$RECORDINGS"/classification_video/pen_thick.dsa later/pen_thick/
"$PALPATE" train -q "$RECORDINGS"/grasps_by_class -o m.json > trained.json
"$PALPATE" evaluate -q --model m.json later{options} 2> notes.txt || [ $? = 3 ]""".strip(),
                {"grasps": (at("grasps"), COUNT), "right": (at("right"), COUNT),
                 "share": (at("accuracy"), share(3)), "top3": (at("top3"), share(3)),
                 "sure": (lambda out: out.json()["coverage"] * out.json()["grasps"], COUNT),
                 "low": (lambda out: out.json()["interval"][0], share(2)),
                 "high": (lambda out: out.json()["interval"][1], share(2))},
                idle=False, recordings=True, show=f"palpate evaluate --model m.json LATER{options}")


def recorder(seconds, rate, hands):
    each = "\n".join(f"""
"$PALPATE" emulate {rate} --dsa "$PWD"/d{i} --sdh "$PWD"/s{i} > e{i}.txt 2>&1 &
hands="$hands $!"
until [ -e d{i} ] && [ -e s{i} ]; do kill -0 $!; sleep 0.05; done""" for i in range(hands))
    records = "\n".join(
        f'"$PALPATE" record -q --dsa "$PWD"/d{i} --sdh "$PWD"/s{i} -o r{i}.palpate --duration {seconds} '
        f"--json > r{i}.json &\nrecords=\"$records $!\"" for i in range(hands))
    if hands == 1:
        records = (f"TIMEFORMAT='processor %U %S'\n" 'time "$PALPATE" record -q --dsa "$PWD"/d0 '
                   f'--sdh "$PWD"/s0 -o r0.palpate --duration {seconds} --json > r0.json')
    return f"""hands= records=
{each}
{records}
for record in $records; do wait $record; done
kill -TERM $hands
wait $hands || true
cat r*.json""".strip()


# Curves of cost against size (docs/notes/growth.md): name -> (what, unit of the size, benchmark, sizes).
FRAMES = [10 ** i for i in range(2, 7)]
CLASSES = [10, 30, 100, 300]
GROWTH = {
    "open": ("opening a `.palpate`", "frames", "growthOpen", FRAMES),
    "open_dsa": ("opening a `.dsa`", "frames", "growthOpenDsa", FRAMES[:4]),
    "timeline": ("the timeline, until all is read", "frames", "growthTimeline", FRAMES),
    "library_first": ("the library, first look", "recordings", "growthLibrary/first", FRAMES[:3]),
    "library_again": ("the library, any later start", "recordings", "growthLibrary/again", FRAMES[:3]),
    "train_grasps": ("`train`, gauss, 20 classes", "grasps", "growthTrainGrasps/gauss", FRAMES[:3]),
    "train_grasps_svm": ("`train`, svm, 20 classes", "grasps", "growthTrainGrasps/svm", FRAMES[:3]),
    "train_classes": ("`train`, gauss, 3000 grasps", "classes", "growthTrainClasses/gauss", CLASSES),
    "train_classes_svm": ("`train`, svm, 3000 grasps", "classes", "growthTrainClasses/svm", CLASSES),
    "classify": ("an answer, gauss", "classes", "growthClassify/gauss", CLASSES + [1000]),
    "signals": ("all signals of a frame", "taxels", "growthSignals", FRAMES),
}


def growth_figures():
    figures = {}
    for name, (_, _, benchmark, sizes) in GROWTH.items():
        for size in sizes:
            figures[f"{name}.s{size}"] = (wall(f"{benchmark}/{size}"), duration)
            figures[f"{name}.mb{size}"] = (counter(f"{benchmark}/{size}", "peak_MB"), fixed(0))
    return figures


def duration(seconds):
    return next(in_unit(unit)(seconds) for unit in ("s", "ms", "us", "ns") if seconds >= SECONDS[unit]
                or unit == "ns")


def slope(points):
    """Exponent of a curve: slope of a line in logarithms through its larger half, where fixed costs matter least."""
    half = points[-max(2, (len(points) + 1) // 2):]
    x = [math.log(size) for size, _ in half]
    y = [math.log(cost) for _, cost in half]
    middle = sum(x) / len(x)
    return sum((a - middle) * b for a, b in zip(x, y)) / sum((a - middle) ** 2 for a in x)


# Kinds of simulated steps (palpate step-benchmark): one line of the table each, with both drifts.
COVERAGE_SHAPES = [("T1 0.5 s, T2 0.12 s", "K m T1 T2"), ("T1 0.5 s, T2 0.005 s", "K m T1 T2"),
                   ("T1 = T2 = 0.3 s", "K m T1 T2"), ("T 0.2 s, d 0.5", "K m T d")]
COVERAGE_KINDS = [(shape, letters.split(), correlation, noise, length, "squares")
                  for shape, letters in COVERAGE_SHAPES for correlation in (0.0, 0.1)
                  for noise in (0.005, 0.03, 0.1) for length in (1.0, 3.0, 12.0)]
COVERAGE_KINDS += [(COVERAGE_SHAPES[0][0], "K m T1 T2".split(), correlation, 0.03, length, loss)
                   for loss in ("huber", "cauchy") for correlation in (0.0, 0.1) for length in (3.0, 12.0)]


def coverage_cells(kind):
    """The cells of a table's line; both drifts one behind the other."""
    shape, letters, correlation, noise, length, loss = kind

    def take(out):
        steps = [step for step in out.json()["steps"]
                 if (step["shape"], step["correlation_s"], step["noise"], step["length_s"], step["loss"]) ==
                 (shape, correlation, noise, length, loss)]
        if not steps:
            raise ValueError(f"no steps {kind}")
        several = lambda write: ", ".join(write(step) for step in steps)
        part = lambda key: several(lambda step: f"{100 * step[key] / step['trials']:.0f}")

        def covered(letter):
            def write(step):
                one = step["stated"][letter]
                if one["stated"] == 0:
                    return "none"
                low = one["high"] < 0.95
                text = f"{100 * one['coverage']:.1f} of {one['stated']}"
                return f"**{text}**" if low else text
            return several(write)
        return " | ".join([part("usable"), part("not_identifiable"), part("not_converged")] +
                          [covered(letter) for letter in letters])
    return take


def coverage_pooled(letter, kinds=lambda step: True):
    def take(out):
        counts = [step["of_usable"][letter] for step in out.json()["steps"] if letter in step["of_usable"] and kinds(step)]
        return 100.0 * sum(one["inside"] for one in counts) / sum(one["stated"] for one in counts)
    return take


PARTS = [
    Part("machine", 1, """
. /etc/os-release
echo "$(nproc) cores, $(sed -n 's/^model name\\s*: //p' /proc/cpuinfo | head -n 1), $PRETTY_NAME"
""".strip(), {"name": (lambda out: out.text.strip(), str)}, idle=False),
    Part("first_time", 1, "cat cmake/first_time.txt", show="scripts/test fresh", figures={
        key: (first_time(key), MEGABYTES if key.endswith("_mb") else COUNT) for key in
        ("cores", "packages_minutes", "program_minutes", "program_mb", "tests_mb")},
        idle=False, origin=first_time_origin),
    Part("call", 5, "scripts/run --version && TIMEFORMAT='call %R' && time scripts/run --version",
         show="time scripts/run --version", figures={
        "unchanged": (number(r"call ([\d.]+)"), S)}),
    Part("suite", 300, "scripts/test", {
        "passed": (number(r"(\d+) passed, 0 failed"), COUNT), "wall": (wall_s, fixed(0, "s"))}),

    bench("dsa", 60, "Reference/(all|large|small)_vs_bzip2/", {
        which: (counter(f"readBesideReference/{which}_vs_bzip2", "ratio"), TIMES)
        for which in ("all", "large", "small")}, recordings=True),
    bench("lbzip2", 10, "readBesideLbzip2", {
        "large": (counter("readBesideLbzip2", "ratio"), TIMES)}, recordings=True),
    bench("folders", 150, "(folder|library)BesideBzip2", {
        **{command: (counter(f"folderBesideBzip2/{'signals_command' if command == 'signals' else command}", "ratio"), TIMES)
           for command in ("info", "verify", "signals", "grasps", "features", "train")},
        "library": (counter("libraryBesideBzip2", "ratio"), TIMES)}, recordings=True),
    bench("load_all", 20, "loadAll", {
        "files": (counter("loadAllBesideDsa", "files"), COUNT),
        "times": (counter("loadAllBesideDsa", "times_faster"), fixed(1))}, recordings=True),
    bench("day", 120, "^day(Opens|RandomFrame|Seconds)", {
        "file": (counter("dayOpens", "file_MB"), MEGABYTES),
        "open": (wall("dayOpens"), S),
        "frame": (counter("dayRandomFrame", "slowest_ms", 1e-3), MS),
        "summary": (wall("daySeconds"), MS),
        "peak": (counter("dayRandomFrame", "peak_MB"), MEGABYTES)},
        env={"PALPATE_BENCHMARK_DAY": "1"}),
] + [
    bench(part, seconds, f"^dayExport/({'|'.join(forms)})/", {
        f"{form}_{what}": (counter(f"dayExport/{form}", key, factor), write)
        for form in forms
        for what, key, factor, write in (("rate", "bytes_per_second", 1e-6, fixed(0, "MB/s")),
                                         ("peak", "peak_MB", 1.0, MEGABYTES),
                                         ("file", "file_MB", 1.0, MEGABYTES))},
        env={"PALPATE_BENCHMARK_DAY": "1"})
    for part, seconds, forms in (("day_exports", 130, ("raw", "h5", "mcap", "csv")),
                                 ("day_exports_slip", 900, ("h5_signals_slip",)))
] + [
    bench("timeline", 150, "timelineOfADay", {
        "drawn": (counter("timelineOfADay", "drawn_s"), S),
        "zoom_median": (counter("timelineOfADay", "zoom_p50_ms", 1e-3), MS),
        "zoom_worst": (counter("timelineOfADay", "zoom_max_ms", 1e-3), MS),
        "all_read": (counter("timelineOfADay", "all_read_s"), S)},
        display=True, env={"PALPATE_BENCHMARK_DAY": "1"}),
] + [
    Part(f"folder_{command}", 4, f'"$PALPATE" {command} -q "$RECORDINGS" > out.txt',
         show=f"palpate {command} FOLDER", figures={
        "processor": (processor_s, S), "peak": (peak_mb, MEGABYTES)}, recordings=True)
    for command in ("info", "signals", "verify", "grasps")
] + [
    Part(f"convert_{form}", 20, f'"$PALPATE" convert -q "$RECORDINGS" -o "out/{{folder}}_{{name}}.{form}"{more}',
         show=f"palpate convert FOLDER -o 'out/{{folder}}_{{name}}.{form}'{more}", figures={
        "wall": (wall_s, S), "peak": (peak_mb, MEGABYTES)}, recordings=True)
    for form, more in (("h5", " --no-slip"), ("mcap", " --no-slip"), ("npz", ""))
] + [
    Part("convert_h5_slip", 25, '"$PALPATE" convert -q "$RECORDINGS" -o "out/{folder}_{name}.h5"',
         show="palpate convert FOLDER -o 'out/{folder}_{name}.h5'", figures={
        "wall": (wall_s, S), "peak": (peak_mb, MEGABYTES)}, recordings=True),
    bench("start", 20, "processTo", {
        "picture": (wall("processToPicture"), S),
        "first_paint": (counter("processToFirstPaint", "first_paint_ms", 1e-3), MS),
        "version": (wall("processToVersion"), MS),
        "info": (wall("processToInfo"), MS)}, display=True),
    bench("playback", 60, "^window/", {
        "playback": (counter("window/playback", "cpu_percent"), PERCENT),
        "repaints": (counter("window/playback", "repaints_per_s"), COUNT),
        "everything": (counter("window/repainting_everything", "cpu_percent"), PERCENT),
        "paused": (counter("window/paused", "cpu_percent"), PERCENT)}, display=True),
    bench("wire", 45, "wireTo", {
        "median": (counter("wireToPixel", "age_p50_ms", 1e-3), MS),
        "p99": (counter("wireToPixel", "age_p99_ms", 1e-3), MS),
        "worst": (counter("wireToPixel", "age_max_ms", 1e-3), MS),
        "core": (counter("wireToPixel", "core_share", 100.0), PERCENT),
        "away": (counter("wireToPixel", "window_away_max_ms", 1e-3), MS),
        "mailbox_p99": (counter("wireToMailbox", "age_p99_ms", 1e-3), MS)}, display=True),
    bench("window_load", 20, "windowUnderLoad", {
        "away": (counter("windowUnderLoad", "window_away_max_ms", 1e-3), MS),
        "turn_p99": (counter("windowUnderLoad", "turn_p99_ms", 1e-3), MS),
        "painted_p99": (counter("windowUnderLoad", "age_p99_ms", 1e-3), MS),
        "lost": (counter("windowUnderLoad", "lost"), COUNT)}, display=True),
    bench("window_replug", 420, "windowReplug", {
        "cycles": (counter("windowReplug", "cycles"), COUNT),
        "noticed_worst": (counter("windowReplug", "noticed_max_ms", 1e-3), MS),
        "back_p99": (counter("windowReplug", "returned_p99_ms", 1e-3), MS),
        "back_worst": (counter("windowReplug", "returned_max_ms", 1e-3), MS),
        "away": (counter("windowReplug", "window_away_max_ms", 1e-3), MS),
        "descriptors": (counter("windowReplug", "descriptors_more"), COUNT),
        "threads": (counter("windowReplug", "threads_more"), COUNT)},
        display=True, env={"PALPATE_BENCHMARK_CYCLES": "500"}),
    bench("window_soak", 735, "windowSoak", {
        **{f"mb_{i}": (counter("windowSoak", f"mb_{i}"), fixed(1)) for i in range(1, 7)},
        "p99": (counter("windowSoak", "age_p99_ms", 1e-3), MS),
        "descriptors": (counter("windowSoak", "descriptors_more"), COUNT),
        "threads": (counter("windowSoak", "threads_more"), COUNT)},
        display=True, env={"PALPATE_BENCHMARK_MINUTES": "12"}),
    bench("hand_view", 25, "^hand[RG]", {
        "raster": (cpu("handRaster/whole"), MS), "repaint": (cpu("handRepaint"), MS),
        "gl": (wall("handGl/whole"), MS), "gl_near": (wall("handGl/near"), MS)}, display=True),

    Part("record", 25, recorder(20, "--scene ball", 1), show="palpate emulate --scene ball`, "
         "`time palpate record --duration 20 --json", figures={
        "processor": (lambda out: sum(map(float, re.search(
            r"processor ([\d.]+) ([\d.]+)", out.text).groups())), S),
        "core": (lambda out: 5.0 * sum(map(float, re.search(
            r"processor ([\d.]+) ([\d.]+)", out.text).groups())), PERCENT),
        "frames": (number(r'"frames": ?(\d+)'), COUNT),
        "lost": (number(r'"lost": ?(\d+)'), COUNT)}),
    Part("record_fast", 25, recorder(20, "--rate 300", 2), show="palpate emulate --rate 300`, "
         "`palpate record --duration 20 --json", figures={
        "frames": (sum_of(r'"frames": ?(\d+)', 2), COUNT),
        "lost": (sum_of(r'"lost": ?(\d+)', 2), COUNT)}),
    bench("packet", 10, "framePacket|textbookChecksum", {
        **{f"{kind}": (cpu(f"framePacket/{kind}"), US) for kind in ("grasp", "noise", "raw")},
        **{f"{kind}.textbook": (cpu(f"textbookChecksum/{kind}"), US)
           for kind in ("grasp", "noise", "raw")}}),

    bench("geometry", 10, "^pose|4x4|sphere|Welzl|contact", {
        "pose": (cpu("pose"), US), "products": (cpu("textbook4x4"), US),
        "sphere": (cpu("sphere/30"), US), "welzl": (cpu("textbookWelzl/30"), US),
        "contact": (cpu("contact/spheres:1"), US), "bare": (cpu("contact/spheres:0"), US)}),
    bench("filters", 30, "filterHand|defaultChain", filter_figures()),
    bench("steps", 20, "Step|TenMinutes|LiveFrame", {
        "fit": (cpu("BM_StepFitOf500Samples"), MS),
        "ceres": (cpu("BM_StepFitOf500SamplesByCeres"), MS),
        "ten_minutes": (cpu("BM_TenMinutesWithThirtySteps"), MS),
        "live": (cpu("BM_CalibrationOfALiveFrame"), US)}),
    bench("slip_time", 25, "slipOfSix|ontest|studyConvolutions", {
        **{m.replace("_", "-"): (cpu(f"slipOfSixMatrices/{m}"), US) for m in
           ("centroid", "alcazar", "ncc_paraboloid", "ncc_gauss3", "phase", "phase_normalized",
            "register")},
        "contest": (cpu("contestOfAPair"), US),
        "study": (cpu("studyConvolutionsOfSixMatrices"), US)}),
    bench("features_time", 10, "featuresOfGrasp|momentInvariants|answerInAnotherSession", {
        "study": (cpu("featuresOfGrasp/study"), US), "best": (cpu("featuresOfGrasp/best"), US),
        "session": (cpu("featuresOfGrasp/session"), US),
        "verdict": (cpu("answerInAnotherSession"), MS)}, recordings=True),
    bench("growth", 300, "^growth", growth_figures(), display=True),
    bench("learning_time", 20, "protocolS|sameByLibsvm|oneVerdict", {
        "ours": (wall("protocolS"), MS), "libsvm": (wall("sameByLibsvm"), MS),
        "verdict_svm": (cpu("oneVerdict/svm"), US), "verdict_gauss": (cpu("oneVerdict/gauss"), MS)},
        recordings=True),
    bench("spectra_time", 30, "spectra|kalman|kelvin|estimation|runningMean", {
        **{f"{n}": (cpu(f"spectra/{n}"), MS) for n in (32, 256, 251)},
        **{f"{n}.opencv": (cpu(f"spectraByOpenCv/{n}"), MS) for n in (32, 256, 251)},
        **{f"{n}.sum": (cpu(f"spectraNaively/{n}"), MS) for n in (32, 256, 251)},
        **{key: (one_value(name), US if key.startswith("em") else NS)
           for key, name in VALUE_FILTERS.items()}}),

    Part("slip", 40, '"$PALPATE" slip-benchmark -q', slip_figures(), idle=False),
    Part("slip_20", 40, '"$PALPATE" slip-benchmark -q --noise 20', slip_figures(), idle=False),
    Part("alarms", 5, '"$PALPATE" slip-benchmark -q --trials 1 --shape disc --recordings "$RECORDINGS"', {
        f"{alarm}.{key}": (at("alarms", "methods", alarm, key), write)
        for alarm in ALARMS for key, write in (
            ("per_hour", in_two), ("per_hour_settled", in_two), ("per_hour_quiet", in_two),
            ("found_part", lambda part: f"{100 * part:.1f} %"), ("slips", COUNT),
            ("delay_median_frames", COUNT), ("delay_p90_frames", COUNT))},
        idle=False, recordings=True),
    Part("coverage", 60, '"$PALPATE" step-benchmark -q --trials 400', {
        **{f"line{i}": (coverage_cells(kind), str) for i, kind in enumerate(COVERAGE_KINDS)},
        "both": (at("usable_and_not_identifiable"), COUNT),
        "usable": (lambda out: sum(step["usable"] for step in out.json()["steps"]), COUNT),
        "trials": (lambda out: sum(step["trials"] for step in out.json()["steps"]), COUNT),
        **{key: (coverage_pooled(key), fixed(1, "%")) for key in ("K", "m", "T1", "T2")},
        **{f"{key}.long": (coverage_pooled(key, lambda step: step["length_s"] == 12.0), fixed(1, "%"))
           for key in ("K", "m", "T1", "T2")}}, idle=False),
    Part("nist", 2, '"$TESTS"/calibration/calibration_tests --file=least_squares_test', {
        "digits": (number(r"mean ([\d.]+) digits"), fixed(1)),
        "runs": (number(r"digits over (\d+) runs"), COUNT)}, idle=False),
] + [
    Part(f"evaluate_{name}_{protocol}", 3,
         f'"$PALPATE" evaluate -q "$RECORDINGS"/grasps_by_class {options} '
         f"{'--splits 100' if protocol == 'S' else '--protocol B'}",
         {"mean": (at("accuracy_mean"), share(3)), "grasps": (at("grasps"), COUNT)},
         idle=False, recordings=True)
    for name, (_, _, options) in PIPELINES.items() for protocol in "SB"
] + [
    later("fresh", ""), later("none", " --session-offset none"),
    later("batch", " --session-offset batch"), later("adapt", " --adapt 1"),

    Part("python_import", 1, "PYTHONPATH=\"$PYTHON\" python3 -X importtime -c 'import palpate'", {
        "import": (number(r"\| +(\d+) \| palpate\n", 1e-6), S)},
        show="python3 -X importtime -c 'import palpate'"),
    Part("package", 90, """
file=$(scripts/package)
file=${file##*$'\n'}
echo "bytes $(stat -c %s "$file") installed $(dpkg-deb -f "$file" Installed-Size)"
""".strip(), show="scripts/package", figures={
        "size": (number(r"bytes (\d+)", 1e-6), fixed(1, "MB")),
        "installed": (number(r"installed (\d+)", 1.024e-3), MEGABYTES),
        "wall": (wall_s, fixed(0, "s"))}),

    slow_test("stops", 240, "control", "safety_slow_test", {
        **{key: (stops("stop_on_the_wire", key), COUNT)
           for key in ("answers", "late", "late_excused", "lost", "in_motion")},
        **{key: (stops("stop_on_the_wire", key + "_ms"), fixed(1, "ms"))
           for key in ("median", "p99", "worst")}}),
    Part("escapes", 400, 'xvfb-run -a -s "-screen 0 1600x1000x24" "$TESTS"/gui/gui_tests '
         "--file=live_safety_slow_test", {
        **{key: (stops("escape_to_the_wire", key), COUNT)
           for key in ("answers", "late", "late_excused", "lost", "in_motion")},
        **{key: (stops("escape_to_the_wire", key + "_ms"), fixed(1, "ms"))
           for key in ("median", "p99", "worst")}}),
    slow_test("reactions", 15, "control", "safety_test", {
        "limit": (stops("frame_over_the_limit_to_stop", "worst_ms"), fixed(1, "ms")),
        "unplugged": (stops("unplugged_to_stop", "worst_ms"), fixed(1, "ms")),
        "silent": (stops("silent_to_stop", "worst_ms"), fixed(1, "ms"))}),
    slow_test("blind_stops", 240, "control", "blind_stop_slow_test", {
        f"{mode}_{key}": take for mode in ("plain", "reactive") for key, take in {
            "answers": (stops(f"{mode}_decision_to_stop", "answers"), COUNT),
            "decision_late": (stops(f"{mode}_decision_to_stop", "late"), COUNT),
            **{f"{way}_{figure}": (stops(f"{mode}_{name}_to_stop", f"{figure}_ms"), fixed(1, "ms"))
               for way, name in (("decision", "decision"), ("bad", "bad_answers"))
               for figure in ("median", "p99", "worst")}}.items()}),
    slow_test("reach", 15, "control", "grasp_reach_test", {
        f"v{velocity}_limit{limit}_{key}": (
            stops(f"reach_{velocity}_deg_per_s_limit_{limit}", field), write)
        for velocity in (10, 2) for limit in (200, 1000, 2000)
        for key, field, write in (("median", "median_counts", COUNT), ("worst", "worst_counts", COUNT),
                                  ("times", "worst_times", fixed(1)))} | {
        f"{scene}_{key}": (stops(f"kept_{scene}", key), write)
        for scene in ("ball", "foam_ball", "bottle")
        for key, write in (("grasps", COUNT), ("kept", COUNT), ("dropped", COUNT),
                           *((key, fixed(1)) for key in (
                               "rest_min_times", "rest_max_times", "first_peak_times",
                               "peak_median_times", "peak_worst_times", "before_peak_median_times",
                               "before_peak_worst_times")),
                           *((key, fixed(1, "s")) for key in ("median_s", "worst_s", "before_median_s")),
                           ("first_s", fixed(0, "s")))}, idle=False),
    slow_test("kills", 900, "commands", "kill_recording_slow_test", {
        "kills": (number(r"(\d+) kills"), COUNT), "open": (number(r"(\d+) files open"), COUNT),
        "journals": (number(r"(\d+) journals"), COUNT),
        "lost": (number(r"at most (\d+) ms lost"), fixed(0, "ms"))}),
    slow_test("damage", 600, "recording", "palpate_long_test", {
        "files": (sum_of(r"(\d+) files:"), COUNT),
        "hoped": (sum_of(r"(\d+) frames lay"), COUNT),
        "saved": (sum_of(r"not hit, (\d+) came back"), COUNT)}, idle=False),
    slow_test("replugs", 600, "device", "replug_slow_test", {
        "cycles": (number(r"(\d+) cycles"), COUNT),
        "noticed": (number(r"noticed after (\d+) ms"), fixed(0, "ms")),
        "back": (number(r"streaming (\d+) ms"), fixed(0, "ms"))}),
    slow_test("noise", 900, "device", "wire_noise_slow_test", {
        "frames": (number(r"noise 0.01 per byte: (\d+) frames"), COUNT),
        "corrupt": (number(r"noise 0.01 per byte: \d+ frames, (\d+) corrupt"), COUNT),
        "wrong": (number(r"noise 0.01 per byte: .* lost, (\d+) wrong"), COUNT),
        "corrupt_less": (number(r"noise 0.001 per byte: \d+ frames, (\d+) corrupt"), COUNT),
        "wrong_less": (number(r"noise 0.001 per byte: .* lost, (\d+) wrong"), COUNT)}, idle=False),
    slow_test("babble", 60, "device", "babble_slow_test", {
        "silent": (number(r"silent after (\d+) ms"), fixed(0, "ms"))}),
    bench("stream", 180, "^stream", {
        "packets_reading_core": (counter("streamPacketsRead", "percent_of_a_core"), fixed(1)),
        "packets_latest": (counter("streamPacketsRecorded", "latest_ms"), fixed(1, "ms")),
        "lines_reading_core": (counter("streamLinesRead", "percent_of_a_core"), fixed(1)),
        "lines_latest": (counter("streamLinesRecorded", "latest_ms"), fixed(1, "ms")),
        "packets_core": (counter("streamPacketsRecorded", "percent_of_a_core"), fixed(1)),
        "packets_lost": (counter("streamPacketsRecorded", "lost"), COUNT),
        "packets_frames": (counter("streamPacketsRecorded", "frames"), COUNT),
        "lines_core": (counter("streamLinesRecorded", "percent_of_a_core"), fixed(1)),
        "lines_lost": (counter("streamLinesRecorded", "lost"), COUNT),
        "lines_frames": (counter("streamLinesRecorded", "frames"), COUNT),
        "packet": (cpu("streamPacketParsed"), US),
        "packet_checksum": (cpu("streamPacketChecksum"), US),
        "line": (cpu("streamLineParsed"), US),
        "line_strtof": (cpu("streamLineStrtof"), US)}),
    slow_test("soak", 200, "capture", "soak_slow_test", {
        "frames": (number(r"(\d+) frames \("), COUNT), "seconds": (number(r"in (\d+) s"), COUNT),
        "warm": (number(r"memory (\d+) ->"), COUNT), "end": (number(r"-> (\d+) MB"), COUNT),
        "descriptors": (number(r"descriptors (\d+)"), COUNT),
        "threads": (number(r"threads (\d+)"), COUNT)}),
]


@dataclass
class Row:
    what: str
    figure: str
    part: str  # whose command and date are shown
    readme: bool = False
    more: str = ""  # behind the command


STOP_FIGURES = ("median {%s.median}, p99 {%s.p99}, worst {%s.worst}; {%s.late} of {%s.answers} late, "
                "{%s.late_excused} of these while the machine stood still")

SECTIONS = {
    "building": [
        Row("first call on an empty Debian: packages, program", "{first_time.packages_minutes} min, "
            "{first_time.program_minutes} min, {first_time.program_mb}", "first_time"),
        Row("program and tests on disk", "{first_time.tests_mb}", "first_time"),
        Row("call when nothing has changed", "{call.unchanged}", "call"),
        Row("fast suite", "{suite.passed} tests in {suite.wall}", "suite"),
    ],
    "files": [
        Row("reading `.dsa` file by file beside `bzip2 -dc` on the same files, wall time on two cores, times as "
            "long: the large ones (target 0.7); the small ones; all shared files",
            "{dsa.large}; {dsa.small}; {dsa.all}", "dsa"),
        Row("the large ones beside `lbzip2 -dc`, times as long (target 1.2)", "{lbzip2.large}", "lbzip2"),
        Row("all shared files as a folder beside `bzip2 -dc`, times as long (target 0.65): `info`, `verify`, "
            "`signals`; `grasps`, `features`; the library's first look; `train`, which also chooses a model",
            "{folders.info}, {folders.verify}, {folders.signals}; {folders.grasps}, {folders.features}; "
            "{folders.library}; {folders.train}", "folders"),
        Row("loading all of them from `.palpate` (target: 10 times faster than from `.dsa`)",
            "{load_all.times} times, {load_all.files} files", "load_all"),
        Row("a recording of 24 h: size; open; slowest of 2000 random frames; its summary; peak memory",
            "{day.file}; {day.open}; {day.frame}; {day.summary}; {day.peak}", "day", True),
        Row("timeline of the same 24 hours: from the file to curves on screen (target 3 s); 300 zooms "
            "anywhere while it is being read (target 100 ms); all read after", "{timeline.drawn}; median "
            "{timeline.zoom_median}, worst {timeline.zoom_worst}; {timeline.all_read}", "timeline"),
    ] + [
        Row(f"all shared recordings: `{command}` of the folder, processor time, peak memory",
            f"{{folder_{command}.processor}}, {{folder_{command}.peak}}", f"folder_{command}")
        for command in ("info", "signals", "verify", "grasps")
    ],
    "exports": [
        Row(f"24 hours of an SDH-2 to {name}: taxels per second (target 100 MB/s), peak memory (target 300 MB), the file",
            f"{{{part}.{form}_rate}}, {{{part}.{form}_peak}}, {{{part}.{form}_file}}", part)
        for form, name, part in (("h5", "`.h5`", "day_exports"),
                                 ("h5_signals_slip", "`.h5` with signals and slip", "day_exports_slip"),
                                 ("mcap", "`.mcap`", "day_exports"), ("csv", "`.csv`", "day_exports"),
                                 ("raw", "a file of counts as they are, the reference", "day_exports"))
    ] + [
        Row(f"all shared recordings (609) to {name}, wall time on two cores{target}, peak memory",
            f"{{{part}.wall}}, {{{part}.peak}}", part)
        for part, name, target in (("convert_h5", "`.h5`", " (target 10 s)"),
                                   ("convert_h5_slip", "`.h5` with slip", ""),
                                   ("convert_mcap", "`.mcap`", ""), ("convert_npz", "`.npz`", ""))
    ],
    "window": [
        Row("from process start to the first paint of the window (target 200 ms); to a picture of the window "
            "with a recording open; `--version` alone (10 ms); `info` of a recording of two frames (15 ms)",
            "{start.first_paint}; {start.picture}; {start.version}; {start.info}", "start"),
        Row("playback, every one of {playback.repaints} repaints/s another frame: part of one core "
            "(target 15 %); repainting everything instead; paused",
            "{playback.playback}; {playback.everything}; {playback.paused}", "playback"),
        Row("live window: wire to pixel (target p99 50 ms); the same without a window", "median "
            "{wire.median}, p99 {wire.p99}, worst {wire.worst}; p99 {wire.mailbox_p99}", "wire", True),
        Row("the whole program meanwhile, with the emulated hand in it (target 20 % of a core); the "
            "window away for at most", "{wire.core}; {wire.away}", "wire"),
        Row("hand in 3-D, without OpenGL: a whole new frame; the view painted again; OpenGL by Mesa "
            "on the processor, far, near", "{hand_view.raster}; {hand_view.repaint}; {hand_view.gl}, "
            "{hand_view.gl_near}", "hand_view"),
        Row("the window with two hands at 300 frames/s and a fit beside it: away for at most (target "
            "50 ms); p99 of a turn of its loop; p99 from wire to pixel",
            "{window_load.away}; {window_load.turn_p99}; {window_load.painted_p99}", "window_load"),
        Row("the window, {window_replug.cycles} times unplugged: noticed (target 500 ms), back (1 s), "
            "more descriptors, threads", "worst {window_replug.noticed_worst}; p99 "
            "{window_replug.back_p99}, worst {window_replug.back_worst}; {window_replug.descriptors}, "
            "{window_replug.threads}", "window_replug"),
        Row("12 minutes on the emulated hand: memory after each two minutes; more descriptors, threads",
            "{window_soak.mb_1}, {window_soak.mb_2}, {window_soak.mb_3}, {window_soak.mb_4}, "
            "{window_soak.mb_5}, {window_soak.mb_6} MB; {window_soak.descriptors}, "
            "{window_soak.threads}", "window_soak"),
    ],
    "disk": [
        Row("recording one emulated hand at 31.7 frames/s and 110 samples of the angles per second for "
            "20 s (target 3 % of a core)", "{record.core} of a core, {record.frames} frames, "
            "{record.lost} lost", "record"),
        Row("two emulated hands at 300 frames/s, recorded for 20 s (target: nothing lost)",
            "{record_fast.frames} frames, {record_fast.lost} lost", "record_fast"),
        Row("a frame packet, framing to counts (target 3 us), beside its checksum alone in the textbook "
            "form: grasp, noise, raw", "{packet.grasp} beside {packet.grasp.textbook}, {packet.noise} "
            "beside {packet.noise.textbook}, {packet.raw} beside {packet.raw.textbook}", "packet"),
    ],
    "computing": [
        Row("a new pose: 486 positions and normals (target 2 us), beside 4x4 products (positions only)",
            "{geometry.pose} beside {geometry.products}", "geometry"),
        Row("smallest sphere of 30 points (target 5 us), beside a textbook Welzl; all contact figures of "
            "60 active taxels", "{geometry.sphere} beside {geometry.welzl}; {geometry.contact}",
            "geometry"),
        Row("six loaded matrices per frame: median 3x3 and Gaussian (target 2 us each), bilateral (15), "
            "beside OpenCV; 3x3x3 median (10); the default chain", "{filters.median} beside "
            "{filters.median.opencv}, {filters.gaussian} beside {filters.gaussian.opencv}, "
            "{filters.bilateral} beside {filters.bilateral.opencv}; {filters.median3d}; {filters.chain}",
            "filters"),
        Row("fit of a step of 500 samples (target 1.5 ms), beside one search of four parameters; ten minutes with 30 steps "
            "(100 ms); calibration of a live frame (2 us)", "{steps.fit} beside {steps.ceres}; "
            "{steps.ten_minutes}; {steps.live}", "steps"),
        Row("slip of six loaded matrices per frame, translation and rotation: centroid (target 3 us), "
            "ncc-gauss3 (60), phase (150), register (150); one contest of slip and load shift (25 per "
            "matrix); the study's way, two full convolutions", "{slip_time.centroid}, "
            "{slip_time.ncc-gauss3}, {slip_time.phase}, {slip_time.register}; {slip_time.contest}; "
            "{slip_time.study}", "slip_time"),
        Row("features of a grasp of 46 frames: study, best, session; an answer in another session",
            "{features_time.study}, {features_time.best}, {features_time.session}; "
            "{features_time.verdict}", "features_time"),
        Row("cross-validation of 571 grasps, 10 splits, wall time; LIBSVM's training alone; an answer, "
            "svm, gauss", "{learning_time.ours}; {learning_time.libsvm}; {learning_time.verdict_svm}, "
            "{learning_time.verdict_gauss}", "learning_time"),
        Row("3205 spectra of 32 samples, beside OpenCV; the sum as it is written",
            "{spectra_time.32} beside {spectra_time.32.opencv}; {spectra_time.32.sum}",
            "spectra_time"),
    ],
    "accuracy": [
        Row("a step of slip, rms, `register`; Cramer-Rao bound", "{slip.register.rmse}; {slip.bound} "
            "taxels", "slip"),
        Row("a load of 40 % that tilts, read as motion: `contest`; `centroid`",
            "{slip.contest.tilt_40}; {slip.centroid.tilt_40} taxels", "slip"),
        Row("real recordings, {alarms.contest.slips} slips: false alarms of `contest` per matrix-hour of "
            "settled contact; slips found", "{alarms.contest.per_hour_settled}; "
            "{alarms.contest.found_part}", "alarms", True),
        Row("NIST StRD by the solver of the step fits, {nist.runs} runs "
            "from both starts: digits on average", "{nist.digits}", "nist"),
        Row("{evaluate_best-gauss_S.grasps} grasps, 36 classes, cross-validated (S, 100 splits): `best`; "
            "the study's features with LDA(14) and svm, with qda", "{evaluate_best-gauss_S.mean}; "
            "{evaluate_study-lda-svm_S.mean}, {evaluate_study-lda-qda_S.mean}", "evaluate_best-gauss_S",
            True),
        Row("another day, offset estimated unlabelled", "{another_day_batch.right} of "
            "{another_day_batch.grasps}", "another_day_batch"),
        Row("another day, one labelled grasp each", "{another_day_adapt.right} of "
            "{another_day_adapt.grasps}", "another_day_adapt"),
    ],
    "reliability": [
        Row("recorder killed at random moments: recordings that open; lost at most", "{kills.open} of "
            "{kills.kills}; {kills.lost}", "kills", True),
        Row("{damage.files} damaged `.palpate` files: frames in blocks that were not hit that came back",
            "{damage.saved} of {damage.hoped}", "damage"),
        Row("both plugs pulled {replugs.cycles} times: noticed, back after at most",
            "{replugs.noticed}, {replugs.back}", "replugs"),
        Row("noise of 1 % of the bytes, {noise.frames} frames: damaged ones taken for good ones",
            "{noise.wrong} of {noise.corrupt}", "noise"),
        Row("a day at full speed, {soak.frames} frames recorded as sent: time; memory warm, at the end",
            "{soak.seconds} s; {soak.warm}, {soak.end} MB", "soak"),
        Row("stops at random moments, each measured once (target 20 ms)",
            STOP_FIGURES.replace("%s", "stops"), "stops", True),
        Row("Esc in the window at random moments, each measured once (target 20 ms)",
            STOP_FIGURES.replace("%s", "escapes"), "escapes"),
    ],
}


def rows_table(rows, commands=True):
    """rows_table(rows)(book): the lines of a table of figures."""
    def write(book):
        lines = ["| what | figure | command | measured |", "|---|---|---|---|"] if commands else \
            ["| what | figure | measured |", "|---|---|---|"]
        for row in rows:
            command = f"{book.part(row.part).shown()}{' ' + row.more if row.more else ''} | " if commands else ""
            lines.append(f"| {book.fill(row.what)} | {book.fill(row.figure)} | {command}{book.when(row.part)} |")
        return lines
    return write


def slip_both_noises_table(book):
    bounds = book.text("slip.bound"), book.text("slip_20.bound")
    lines = [f"| method | step, sd 5 (CRB {bounds[0]}) | x CRB | step, sd 20 ({bounds[1]}) | x CRB | "
             "gain x, y | after 100, sd 5 | turn, sd 5 (deg) | edge | tilt |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    for method in METHODS:
        text = lambda key, part="slip": book.text(f"{part}.{method}.{key}")
        lines.append(f"| `{method}` | {text('rmse')} | {text('of_bound')} | {text('rmse', 'slip_20')} | "
                     f"{text('of_bound', 'slip_20')} | {text('gain_x')}, {text('gain_y')} | "
                     f"{text('drift_100')} | {text('rmse_deg')} | {text('edge_1_5')} | "
                     f"{text('tilt_40')} |")
    return lines


def recognition_table(book):
    lines = ["| features | classifier | S | reference | B |", "|---|---|---|---|---|"]
    for name, (features, classifier, _) in PIPELINES.items():
        lines.append(f"| {features} | {classifier} | {book.text(f'evaluate_{name}_S.mean')} | "
                     f"{SCIKIT.get(name, '')} | {book.text(f'evaluate_{name}_B.mean')} |")
    return lines


def another_day_table(book):
    lines = ["| | right (figures) | 95 % | top-3 | sure |", "|---|---|---|---|---|"]
    for label, name in (("fresh model (nothing known)", "fresh"),
                        ("`--session-offset none`", "none"),
                        ("`--session-offset batch`", "batch"), ("`--adapt 1`", "adapt")):
        text = lambda key: book.text(f"another_day_{name}.{key}")
        lines.append(f"| {label} | {text('right')} of {text('grasps')} = {text('share')} | "
                     f"{text('low')} .. {text('high')} | {text('top3')} | {text('sure')} |")
    return lines


def alarms_table(book):
    lines = ["| alarm | false per hour | slips found | delay, median / 90 %, frames |",
             "|---|---|---|---|"]
    for name, label in ALARMS.items():
        text = lambda key: book.text(f"alarms.{name}.{key}")
        lines.append(f"| {label} | {text('per_hour')} / {text('per_hour_settled')} / "
                     f"{text('per_hour_quiet')} | {text('found_part')} | "
                     f"{text('delay_median_frames')} / {text('delay_p90_frames')} |")
    return lines


def filters_table(book):
    names = [("`median` (target 2)", "median"), ("`gaussian` (target 2)", "gaussian"),
             ("`box`", "box"), ("`bilateral` (target 15)", "bilateral"),
             ("`median3d` (target 10)", "median3d"), ("`min-median`", "minMedian"),
             ("`opening:shape=ellipse,size=5`", "opening"), ("`nlm`", "nonLocalMeans"),
             ("`median:size=5`", "median5x5"), ("`kalman`", "kalman"),
             ("`temporal-min`", "temporalMin"), ("`running-mean`", "runningMean"),
             ("`savitzky-golay:window=7`", "savitzkyGolay"),
             ("the default chain of high sensitivity", "chain")]
    lines = ["| filter | figure, per frame | OpenCV |", "|---|---|---|"]
    for label, name in names:
        beside = book.text(f"filters.{name}.opencv") if name in ("median", "gaussian",
                                                                 "bilateral") else ""
        lines.append(f"| {label} | {book.text(f'filters.{name}')} | {beside} |")
    return lines


def coverage_table(book):
    lines = ["| shape | noise | loss | standard deviation / K | length | usable, % | not identifiable, % | not "
             "converged, % | K, % | m, % | T1 (T), % | T2 (d), % |", "|---|---|---|---|---|---|---|---|---|---|---|---|"]
    for i, (shape, _, correlation, noise, length, loss) in enumerate(COVERAGE_KINDS):
        lines.append(f"| {shape} | {'correlated' if correlation else 'white'}{', 5 % outliers' if loss != 'squares' else ''} "
                     f"| {loss} | {100 * noise:g} % | {length:g} s | {book.text(f'coverage.line{i}')} |")
    return lines


def growth_points(book, name):
    """(size, seconds, MB) of each size of a curve that was measured."""
    values = book.parts.get("growth", {}).get("figures", {})
    return [(size, values[f"{name}.s{size}"], values[f"{name}.mb{size}"])
            for size in GROWTH[name][3] if f"{name}.s{size}" in values]


def growth_table(book):
    lines = ["| cost | size | time | exponent | memory, MB |", "|---|---|---|---|---|"]
    for name, (what, unit, _, sizes) in GROWTH.items():
        points = growth_points(book, name)
        exponent = f"{slope([point[:2] for point in points]):.2f}" if len(points) > 1 else "(to be measured)"
        lines.append(f"| {what} | {', '.join(f'{size:,}' for size in sizes)} {unit} | "
                     f"{', '.join(book.text(f'growth.{name}.s{size}') for size in sizes)} | {exponent} | "
                     f"{', '.join(book.text(f'growth.{name}.mb{size}') for size in sizes)} |")
    return lines


def growth_picture(book):
    """The curves in logarithms, as SVG."""
    width, height, left, top, plot_width, plot_height = 900, 520, 70, 20, 520, 440
    colours = ["#1b6ca8", "#d1495b", "#2e933c", "#8d5a97", "#c97b12", "#13797b", "#7a4b2a", "#5b5f97", "#a23b72",
               "#557a0f", "#444444"]
    curves = {name: growth_points(book, name) for name in GROWTH}
    x = lambda size: left + plot_width * (math.log10(size) - 1) / 5
    y = lambda seconds: top + plot_height * (1 - (math.log10(seconds) + 7) / 9)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
             'font-size="13">', f'<rect width="{width}" height="{height}" fill="white"/>']
    for power in range(1, 7):
        lines.append(f'<path d="M{x(10 ** power):.1f} {top}v{plot_height}" stroke="#ddd"/><text x="{x(10 ** power):.1f}" '
                     f'y="{top + plot_height + 18}" text-anchor="middle">{10 ** power:,}</text>')
    for power in range(-7, 3):
        lines.append(f'<path d="M{left} {y(10.0 ** power):.1f}h{plot_width}" stroke="#ddd"/><text x="{left - 6}" '
                     f'y="{y(10.0 ** power) + 4:.1f}" text-anchor="end">{duration(1.0001 * 10.0 ** power)}</text>')
    lines.append(f'<text x="{left + plot_width / 2}" y="{height - 16}" text-anchor="middle">frames, recordings, grasps, '
                 'classes, taxels</text>')
    for (name, points), colour, row in zip(curves.items(), colours, range(len(curves))):
        at = " ".join(f"{x(size):.1f},{y(seconds):.1f}" for size, seconds, _ in points)
        label = f"{GROWTH[name][0]} ({GROWTH[name][1]})".replace("`", "")
        lines.append(f'<polyline points="{at}" fill="none" stroke="{colour}" stroke-width="2"/>')
        lines += [f'<circle cx="{x(size):.1f}" cy="{y(seconds):.1f}" r="3" fill="{colour}"/>'
                  for size, seconds, _ in points]
        lines.append(f'<text x="{left + plot_width + 16}" y="{top + 16 + 22 * row}" fill="{colour}">{label}</text>')
    return "\n".join(lines + ["</svg>"]) + "\n"


# Files that are written anew with the pages.
PICTURES = {"docs/pictures/growth.svg": growth_picture}
TABLES = {name: rows_table(rows) for name, rows in SECTIONS.items()}
TABLES["readme"] = rows_table([row for rows in SECTIONS.values() for row in rows if row.readme], commands=False)
TABLES["slip_both_noises"] = slip_both_noises_table
TABLES["recognition_pipelines"] = recognition_table
TABLES["another_day"] = another_day_table
TABLES["alarms"] = alarms_table
TABLES["filter_times"] = filters_table
TABLES["coverage"] = coverage_table
TABLES["growth"] = growth_table
