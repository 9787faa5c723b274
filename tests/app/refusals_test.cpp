// Bad input and wrong use: exit code, one sentence, nothing lost and nothing left.

#include <algorithm>
#include <regex>

#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

struct Case {
  std::string name;
  std::string data;  // written to d.csv
  std::string line;  // the shell line
  int code;
  std::string sentence;    // a regular expression that the one line on standard error holds
  std::string other = {};  // written to other.toml
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

const std::string kGood = "t,y\n1,1100\n2,1000\n";
const std::string kRun = "mote run local-level --data d.csv --out e.csv --summary s.json -n 50 ";
const std::string kBudget = "mote run local-level --data d.csv --out e.csv ";
const std::string kTruthRun =
    "mote run local-level --data x.csv --truth d.csv --out e.csv; code=$?; rm x.csv; exit $code";
const std::string kLinear = "mote run linear-gaussian --data d.csv --out e.csv --set file=other.toml";
const std::string kJson =
    "mv other.toml o.json; mote run linear-gaussian --data d.csv --out e.csv --set file=o.json; code=$?; mv o.json "
    "other.toml; exit $code";
const std::string kMatrices =
    "F=[[1,0],[0,1]]\nQ=[[1,0],[0,1]]\nH=[[1,0]]\nR=[[1]]\nmean=[0,0]\ncovariance=[[1,0],[0,1]]\n";

/// Where, what, expected, got, next step; "this version of mote does not have" says where, what and next step only.
const std::regex kFiveFacts(R"(^[^\n]+: expected [^\n]+, got [^\n]+\. [A-Z][^\n]+[.?]\n$)");
const std::regex kNotInThisVersion(
    R"(^mote [a-z]+: --[^\n]+: (this version of mote does not have|the model's noise) [^\n]+\. [A-Z][^\n]+\.\n$)");

class Refused : public ::testing::TestWithParam<Case> {};

TEST_P(Refused, InOneSentence) {
  const Case& c = GetParam();
  if (c.line.find("ulimit -v") != std::string::npos && !kMemoryIsMoteOwn) GTEST_SKIP() << "a sanitizer's own memory";
  const Scratch scratch;
  if (!c.data.empty()) scratch.write("d.csv", c.data);
  if (!c.other.empty()) scratch.write("other.toml", c.other);
  scratch.write("kept.csv", "precious");
  const auto before = scratch.files();
  const Ended ended = scratch.shell(c.line);
  EXPECT_EQ(ended.code, c.code) << ended.err;
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_TRUE(std::regex_search(ended.err, std::regex(c.sentence))) << ended.err;
  EXPECT_TRUE(c.code == 4 || std::regex_match(ended.err, kFiveFacts) || std::regex_match(ended.err, kNotInThisVersion))
      << ended.err;
  EXPECT_EQ(scratch.files(), before) << "a refusal leaves no file and changes none";
}

const std::vector<Case> kData{
    {"MissingFile", "", kRun, 3, R"(^d\.csv: expected a file that can be read, got no such file)"},
    {"EmptyFile", "", "touch z.csv; mote run local-level --data z.csv; code=$?; rm z.csv; exit $code", 3,
     R"(z\.csv: expected a header line and rows of data, got an empty file)"},
    {"OnlyBlankLines", "\n \n", kRun, 3, "an empty file"},
    {"NothingToRead", "", "mote run local-level --data /dev/null", 3, "an empty file"},
    {"NoEndOfZeros", "", "mote run local-level --data /dev/zero", 3, "a byte 0, as in a binary file"},
    {"OtherLetters", std::string("\xff\xfet\0,\0y\0", 8), kRun, 3, "a byte 0, as in a binary file"},
    {"NameOverTwoLines", "", "mote run local-level --data 'no\nsuch'", 3, R"(^no\?such: expected a file)"},
    {"Semicolons", "t;y\n1;2\n", kRun, 3, R"(got "t;y"\. Separate the columns by commas)"},
    {"DecimalComma", "t,y\n1,2,5\n", kRun, 3, "Write numbers with a point"},
    {"LongHeader", "t," + std::string(5000, 'z') + "\n1,1\n", kRun, 3, R"(header: .*zzz\.\.\.")"},
    {"HeaderOnly", "t,y\n", kRun, 3, "rows of data after the header, got none"},
    {"NoHeader", "1,1100\n2,1000\n", kRun, 3, R"(d\.csv:1: first column: expected "t", got "1")"},
    {"FirstColumnNotTime", "y,t\n1,1\n", kRun, 3, R"(first column: expected "t", got "y")"},
    {"WrongColumn", "t,z\n1,1100\n", kRun, 3, R"(d\.csv:1: header: expected a column "y" for local-level)"},
    {"TextInNumber", "t,y\n1,1100\n2,n/a\n", kRun, 3,
     R"(d\.csv:3: column "y": expected a finite number or an empty field, got "n/a")"},
    {"HalfANumber", "t,y\n1,11x\n", kRun, 3, R"(d\.csv:2: column "y".*got "11x")"},
    {"Hexadecimal", "t,y\n1,0x10\n", kRun, 3, R"(column "y".*got "0x10")"},
    {"Infinity", "t,y\n1,inf\n", kRun, 3, R"(column "y".*finite number.*got "inf")"},
    {"TooLargeANumber", "t,y\n1,1e999\n", kRun, 3, R"(column "y".*got "1e999")"},
    {"TimeDecreases", "t,y\n2,1\n1,1\n", kRun, 3, R"(d\.csv:3: column "t": expected at least 2)"},
    {"TimeZero", "t,y\n0,1\n", kRun, 3, R"(column "t": expected an integer from 1)"},
    {"TimeNegative", "t,y\n-1,1\n", kRun, 3, R"(column "t".*got "-1")"},
    {"TimeFraction", "t,y\n1.5,1\n", kRun, 3, R"(column "t".*got "1.5")"},
    {"TimeEmpty", "t,y\n,1\n", kRun, 3, R"(column "t")"},
    {"TimeTooLarge", "t,y\n99999999999,1\n", kRun, 3, R"(column "t": expected an integer from 1 to 2147483646)"},
    {"HugeGap", "t,y\n1,1\n2000000000,1\n", kRun, 3, "a gap of at most 10000000 steps"},
    {"TruncatedLine", "t,y\n1,1100\n2", kRun, 3, R"(d\.csv:3: expected 2 fields as in the header, got 1)"},
    {"TooManyFields", "t,y\n1,1,1\n", kRun, 3, "expected 2 fields as in the header, got 3"},
    {"ColumnTwice", "t,y,y\n1,1,1\n", kRun, 3, R"(every column once, got "y" twice)"},
    {"FrameWithAHole", "t,doa1,doa3\n1,0.1,0.1\n", "mote run doa --data d.csv --out e.csv", 3,
     R"(a column "doa2" for doa)"},
    {"FrameTooShort", "t,doa1,doa2\n1,0.1,0.1\n2,0.1\n", "mote run doa --data d.csv", 3,
     R"(d\.csv:3: expected 3 fields)"},
    {"InputMissing", "t,bearing,sensor_x\n1,0.1,\n", "mote run bearings --data d.csv", 3,
     R"(column "sensor_x": expected a finite number, since the row is observed)"},
    {"Garbage", std::string("\x01\x02\xff\xfe\n\x03\n", 6), kRun, 3, R"(d\.csv:1: first column: expected "t")"},
    {"ZeroBytes", std::string("t,y\n1,1\0\0\n", 10), kRun, 3, R"(d\.csv:2: expected text, got a byte 0)"},
    {"DataIsAFolder", kGood, "mkdir f; mote run local-level --data f; code=$?; rmdir f; exit $code", 3,
     "f: expected a file that can be read, got a folder"},
    {"TruthMissing", kGood, kRun + "--truth no.csv", 3, R"(no\.csv: expected a file)"},
    {"TruthWithoutStates", kGood, kRun + "--truth d.csv", 3, R"(at least one state of the model \(level\))"},
    {"TruthWithEqualTimes", "t,level\n1,3\n1,4\n", "mote simulate local-level --out x.csv; " + kTruthRun, 3,
     R"(d\.csv:3: column "t": expected more than 1)"},
    {"TruthWithoutRows", "t,level\n", "mote simulate local-level --out x.csv; " + kTruthRun, 3,
     R"(d\.csv:1: expected rows of data)"},
    {"TruthOfText", "t,level\n1,high\n", "mote simulate local-level --out x.csv; " + kTruthRun, 3,
     R"(d\.csv:2: column "level": expected a finite number)"},
    {"CollapseOfAChain", "t,y\n1,1e300\n", kRun + "--filter imh", 4, "collapsed.*--on-collapse keep"},
    {"Collapse", "t,y\n1,1e300\n", kRun, 4, "collapsed.*--on-collapse keep"},
};

const std::vector<Case> kUse{
    {"NoData", "", "mote run local-level", 2, "--data: expected a CSV file with the recording, got nothing"},
    {"ZeroParticles", kGood, kRun + "-n 0", 2, "--particles: expected an integer from 1 to 268435456, got 0"},
    {"UnknownModel", kGood, "mote run nope --data d.csv", 2, R"(MODEL: expected one of ungm, .*got "nope")"},
    {"NearModel", kGood, "mote run local-leve --data d.csv", 2, R"(got "local-leve"\. Did you mean local-level\?)"},
    {"NoModel", "", "mote run", 2, "MODEL: expected a model of the catalogue .*, got nothing"},
    {"NoCommand", "", "mote", 2, "COMMAND: expected one of models, .*, got nothing. See mote --help"},
    {"UnknownCommand", "", "mote frobnicate", 2, R"(COMMAND: expected one of models, .*got "frobnicate")"},
    {"NearCommand", "", "mote simulat ungm", 2, "Did you mean simulate"},
    {"WordBeforeCommand", "", "mote fast run ungm", 2, R"(COMMAND: .*got "fast")"},
    {"OptionOfNoCommand", "", "mote --frobnicate", 2, R"(mote: expected an option of mote, got "--frobnicate")"},
    {"UnknownOption", kGood, kRun + "--frobnicate 3", 2, R"(expected an option of mote run, got "--frobnicate")"},
    {"NearOption", kGood, kRun + "--partcles=3", 2, R"(got "--partcles"\. Did you mean --particles\?)"},
    {"UnknownLetter", kGood, kRun + "-x", 2, R"(expected an option of mote run, got "-x")"},
    {"FurtherWord", kGood, kRun + "extra", 2, R"(expected no further word, got "extra")"},
    {"CommandAsWord", kGood, kRun + "models", 2, R"(expected no further word, got "models")"},
    {"OptionsAfterDashes", kGood, "mote run local-level -- --data d.csv", 2, "Pass it before the word --"},
    {"SecondModel", "", "mote models ungm doa", 2, R"(expected no further word, got "doa")"},
    {"FlagWithValue", "", "mote models --json=no", 2, R"(--json: expected no value, got "no")"},
    {"MissingValue", "", "mote run local-level --data", 2, "--data: expected FILE, got nothing"},
    {"EmptyValue", kGood, kRun + "--report ''", 2, "--report: expected FILE, got nothing"},
    {"EmptyParticles", kGood, "mote run local-level --data d.csv -n ''", 2, "--particles: expected N, got nothing"},
    {"UnknownFilter", kGood, kRun + "--filter magic", 2, R"(--filter: expected one of sisr, imh, .*got "magic")"},
    {"UnknownResampler", kGood, kRun + "--resampler magic", 2, "--resampler: expected one of systematic"},
    {"UnknownEngine", kGood, kRun + "--engine warp", 2, "--engine: expected one of"},
    {"UnknownParameter", kGood, kRun + "--set nope=3", 2,
     R"(--set: expected a parameter of local-level \(var_level, .*got "nope")"},
    {"UnknownProposal", kGood, kRun + "--proposal nope", 2, "--proposal"},
    {"UnknownEstimate", kGood, kRun + "--estimate 'q2(level)'", 2, "--estimate: expected mean"},
    {"EstimateOfNothing", kGood, kRun + "--estimate 'mean(nope)'", 2, "f one of level"},
    {"SetWithoutSign", kGood, kRun + "--set q", 2, "--set: expected name=value"},
    {"SetTwice", kGood, kRun + "--set p0=3 --set p0=4", 2, "expected one value, got two"},
    {"SetNothing", kGood, kRun + "--set =3", 2, "--set: expected name=value"},
    {"SetEmpty", kGood, kRun + "--set ''", 2, "--set: expected NAME=VALUE, got nothing"},
    {"SetListed", kGood, kRun + "--set p0=3 var_obs=4", 2, "Pass --set before every name=value"},
    {"SetNear", kGood, kRun + "--set levle0=4", 2, R"(got "levle0"\. Did you mean level0\?)"},
    {"SetInfinite", kGood, kRun + "--set level0=inf", 2, "--set level0: expected a finite number"},
    {"SetTooLarge", kGood, kRun + "--set level0=1e999", 2, "--set level0: expected a finite number"},
    {"SetNoNumber", kGood, kRun + "--set p0=abc", 2, "--set p0: expected a number of at least 0"},
    {"NegativeVariance", kGood, kRun + "--set var_obs=-1", 2, "--set var_obs: expected a number above 0, got \"-1\""},
    {"ZeroObservationVariance", kGood, kRun + "--set var_obs=0", 2, "expected a number above 0"},
    {"NanParameter", kGood, kRun + "--set p0=nan", 2, "--set p0"},
    {"ThreeCopies", kGood, "mote run ungm --data d.csv --set copies=3", 2, "copies: expected an integer from 1 to 2"},
    {"SeedTooLarge", kGood, kRun + "--seed 9223372036854775808", 2,
     "--seed: expected an integer from 0 to 9223372036854775807"},
    {"SeedFraction", kGood, kRun + "--seed 1.5", 2, "--seed: expected an integer"},
    {"NegativeParticles", kGood, kRun + "-n -5", 2, "--particles: expected an integer from 1 to 268435456, got -5"},
    {"BeyondMemory", kGood, "ulimit -v 500000; mote run local-level --data d.csv --out e.csv -n 100000000", 2,
     "--particles: expected particles that fit into the 0.[0-9] GB of memory there are, got 100000000"},
    {"NoThreads", kGood, kRun + "--threads 0", 2, "--threads: expected an integer from 1 to 4096"},
    {"NearFilter", kGood, kRun + "--filter sis", 2, "Did you mean sisr"},
    {"UnknownPrecision", kGood, kRun + "--precision half", 2,
     R"(one of float, double, got "half"\. Pass --precision double)"},
    {"BurnInOfWords", kGood, kRun + "--filter imh --burn-in x", 2, "--burn-in: expected auto, or an integer from 0"},
    {"DrawsOfWords", kGood, kRun + "--filter imh --draws x", 2, "--draws: expected an integer.*Leave --draws out"},
    {"EstimateTwice", kGood, kRun + "--estimate 'mean(level)' --estimate 'mean( level )'", 2, "every function once"},
    {"SeedNegative", kGood, kRun + "--seed -1", 2, "--seed: expected an integer from 0"},
    {"ThresholdTooLarge", kGood, kRun + "--ess-threshold 1.5", 2,
     "--ess-threshold: expected a number from 0 to 1, got 1.5"},
    {"ThresholdNan", kGood, kRun + "--ess-threshold nan", 2, "--ess-threshold"},
    {"BurnInNegative", kGood, kRun + "--filter imh --burn-in -1", 2, "--burn-in"},
    {"DrawsBelowParticles", kGood, kRun + "--filter imh --draws 10", 2,
     "--draws: expected an integer from the number of particles"},
    {"MoreChainsThanParticles", kGood, kRun + "--filter imh --chains 51", 2, "--chains: expected an integer from 1"},
    {"MoreGroupsThanParticles", kGood, kRun + "--filter distributed --groups 51", 2, "--groups: expected"},
    {"ExchangeTooMany", kGood, kRun + "--filter distributed --groups 10 --exchange swap --exchange-count 6", 2,
     "--exchange-count: expected an integer from 1 to 5"},
    {"CubeOfTen", kGood, kRun + "--filter distributed --groups 10 --exchange swap --topology hypercube", 2,
     "--topology hypercube: expected a power of two for --groups, got 10. Pass --groups 8, or --topology torus"},
    {"NeverExchanges", kGood, kRun + "--filter distributed --groups 10 --exchange swap --exchange-every 0", 2,
     "--exchange-every: expected an integer from 1"},
    {"MoreThanAllGroups", kGood, kRun + "--filter distributed --groups 10 --exchange swap --exchange-when 1.5", 2,
     "--exchange-when: expected a number from 0 to 1, got 1.5"},
    {"ImprovedSisr", kGood, kRun + "--improved", 2, "--improved: expected --filter imh or auxiliary"},
    {"LookaheadImh", kGood, kRun + "--filter imh --parent-weights lookahead", 2, "--parent-weights lookahead"},
    {"PipelineHasNoGroups", kGood, kRun + "--engine pipeline --filter distributed", 2,
     "--engine pipeline: expected --filter sisr, imh or auxiliary, got --filter distributed"},
    {"ProposersOfAnotherEngine", kGood, kRun + "--proposers 2", 2,
     "--proposers: expected --engine pipeline or mpi, whose stages it mans, got --engine simd. Pass --engine pipeline "
     "--proposers 2"},
    {"WeighersOfTheReference", kGood, kRun + "--engine reference --weighers 3", 2,
     "--weighers: expected --engine pipeline or mpi, whose stages it mans, got --engine reference"},
    {"NoProposers", kGood, kRun + "--engine pipeline --proposers 0", 2,
     "--proposers: expected an integer from 1 to 64, got 0"},
    {"TooManyWeighers", kGood, kRun + "--engine pipeline --weighers 65", 2,
     "--weighers: expected an integer from 1 to 64, got 65"},
    {"WeighersNotWhole", kGood, kRun + "--engine pipeline --weighers 1.5", 2,
     "--weighers: expected an integer from 1 to 64"},
    {"SimdHasNoGroups", kGood, kRun + "--engine simd --filter distributed", 2, "--engine simd: expected --filter sisr"},
    {"EkfOfStudentsNoise", "t,bearing\n1,0.1\n", "mote run bearings --data d.csv --set dof=3 --filter ekf", 2,
     "--filter ekf: expected a model whose noise is Gaussian, got one that draws uniform numbers"},
    {"CheckpointEveryWithoutAFile", kGood, kRun + "--checkpoint-every 3", 2,
     "--checkpoint-every: expected --checkpoint FILE beside it, got none"},
    {"CheckpointEveryZeroSteps", kGood, kRun + "--checkpoint c --checkpoint-every 0", 2,
     "--checkpoint-every: expected an integer from 1 to 1000000000, got 0"},
    {"CheckpointAndDump", kGood, kRun + "--checkpoint c --dump-particles p.csv", 2,
     "--checkpoint: expected no --dump-particles beside it"},
    {"CheckpointOverTheData", kGood, kRun + "--checkpoint d.csv", 2,
     R"(d\.csv: expected an output in a file of its own)"},
    {"CheckpointOverTheEstimates", kGood, kRun + "--checkpoint e.csv", 2, "every output in a file of its own"},
    {"CheckpointOfAnotherKind", kGood, kRun + "--checkpoint kept.csv", 3,
     R"(kept\.csv: expected a checkpoint of mote run, got a file of another kind)"},
    {"CheckpointInADevice", kGood, kRun + "--checkpoint /dev/full", 2, "got something that is no regular file"},
    {"CheckpointOnStandardOutput", kGood, kRun + "--checkpoint -", 2, "got something that is no regular file"},
    {"CheckpointInNoFolder", kGood, kRun + "--checkpoint no/c", 6, "no/c: expected an output that can be written"},
    {"CheckpointOfACompare", kGood, "mote compare local-level --checkpoint c", 2, R"(got "--checkpoint")"},
    {"BudgetAndParticles", kGood, kRun + "--budget 1ms", 2, "--budget: expected no --particles beside it"},
    {"BudgetWithoutUnit", kGood, kBudget + "--budget 1", 2,
     R"(--budget: expected a number above 0 with its unit \(ms, us, ns, s\))"},
    {"BudgetOfNothing", kGood, kBudget + "--budget 0ms", 2, R"(--budget: expected a number above 0 .*got "0ms")"},
    {"BudgetInWords", kGood, kBudget + "--budget soon", 2, R"(--budget: expected a number above 0 .*got "soon")"},
    {"BudgetOfAFilterThatStays", kGood, kBudget + "--budget 1ms --filter sqmc", 2,
     "--budget: expected --filter sisr, imh or auxiliary"},
    {"BudgetOfAPipeline", kGood, kBudget + "--budget 1ms --engine pipeline", 2,
     "--budget: expected --engine simd or reference, got --engine pipeline"},
    {"BudgetAndDraws", kGood, kBudget + "--filter imh --most-particles 100 --draws 2000", 2,
     "--most-particles: expected no --draws beside it"},
    {"BudgetAndCheckpoint", kGood, kBudget + "--budget 1ms --checkpoint c", 2,
     "--budget: expected no --checkpoint beside it"},
    {"BudgetTwice", kGood, kBudget + "--budget 1ms --most-particles 100", 2,
     "--most-particles: expected no --budget beside it"},
    {"FewerParticlesThanChains", kGood, kBudget + "--filter imh --chains 100 --most-particles 70", 2,
     "--most-particles: expected an integer from 100"},
    {"ErrorWithoutBudget", kGood, kBudget + "--mc-error 0.1", 2, "--mc-error: expected --budget or --most-particles"},
    {"ErrorOfMoreThanOne", kGood, kBudget + "--budget 1ms --mc-error 2", 2,
     "--mc-error: expected a number from 0 to 1"},
    {"BinsInWords", kGood, kBudget + "--budget 1ms --bins wide", 2, "--bins: expected widths of at least 0"},
    {"BinsForOtherStates", kGood, kBudget + "--most-particles 100 --bins 1,2", 2,
     "--bins: expected a width for each of the model's 1 states, got 2"},
    {"TooManyParticles", kGood, kRun + "-n 268435457", 2, "--particles: expected an integer from 1 to 268435456"},
    {"ParticlesInWords", kGood, kRun + "-n many", 2, "--particles: expected an integer"},
    {"ParticlesWithExponent", kGood, kRun + "-n 1e3", 2, "--particles: expected an integer"},
    {"SumOverParentsWithoutDensity", "t,bearing\n1,0.1\n",
     "mote run bearings --data d.csv --filter imh --proposal wide", 2, "fewer dimensions than its state"},
    {"NoStepsToSimulate", "", "mote simulate ungm --steps 0 --out o.csv", 2, "--steps: expected an integer from 1"},
    {"SimulateToNowhere", "", "mote simulate ungm", 2, "--out: expected a file for the observations"},
    {"TooManySteps", "", "mote simulate ungm --steps 10000001 --out o.csv", 2, "--steps: expected an integer from 1"},
    {"UnknownPaper", "", "mote reproduce nature --out r", 2, "PAPER: expected one of imh-hw"},
};

const std::string kText = "mote run other.toml --data d.csv --out e.csv ";
const std::string kWalk =
    "[parameters]\nq = 1\n[states]\nlevel = \"normal(1000, 100)\"\n[next]\nlevel = \"level + sqrt(q)*normal(0, 1)\"\n"
    "[observations]\ny = \"normal(level, 50)\"\n";

const std::vector<Case> kFiles{
    {"TextModelMissing", kGood, "mote run no.toml --data d.csv", 3, R"(no\.toml: expected a file that can be read)"},
    {"TextModelOfMatrices", kGood, kText, 3, R"(other\.toml:1: expected a section or key of a model, got "F")",
     "F=1\n"},
    {"TextModelBroken", kGood, kText, 3, R"(other\.toml:1: expected TOML)", "[states\n"},
    {"TextModelInOtherLetters", kGood, kText, 3, R"(other\.toml:2: expected plain ASCII)", "name='a'\n#\xd0\xbb\n"},
    {"TextModelWithAStrangeWord", kGood, kText, 3, R"(other\.toml:2: x: expected a function, got "nromal")",
     "[states]\nx = \"nromal(0, 1)\"\n[next]\nx = \"x\"\n[observations]\ny = \"normal(x, 1)\"\n"},
    {"TextModelWithoutThatParameter", kGood, kText + "--set r=1", 2, R"(--set: expected a parameter of other\.toml)",
     kWalk},
    {"TextModelWithAParameterInWords", kGood, kText + "--set q=big", 2, "--set q: expected a finite number", kWalk},
    {"TextModelWithAParameterOfNoUse", kGood, kText + "--set q=-1", 3,
     R"(other\.toml:6: level: expected parameters that give finite numbers)", kWalk},
    {"TextModelWithoutItsColumn", "t,z\n1,2\n", kText, 3, R"(d\.csv)", kWalk},
    {"TextModelWithAProposal", kGood, kText + "--proposal guided", 2, "--proposal: expected one of", kWalk},
    {"NoMatrices", kGood, "mote run linear-gaussian --data d.csv", 2, "--set file"},
    {"MatricesMissing", kGood, "mote run linear-gaussian --data d.csv --set file=no.toml", 3,
     R"(no\.toml: expected a file)"},
    {"MatricesBroken", kGood, "mote run linear-gaussian --data d.csv --set file=other.toml", 3,
     R"(other\.toml:1: expected TOML)", "F=[[1\n"},
    {"MatricesInOtherLetters", kGood, "mote run linear-gaussian --data d.csv --set file=other.toml", 3,
     R"(other\.toml:2: expected plain ASCII)", "F=[[1]]\n\xd0\xbb=1\n"},
    {"MatricesIncomplete", kGood, "mote run linear-gaussian --data d.csv --set file=other.toml", 3,
     R"("Q": expected a key of that name)", "F=[[1]]\n"},
    {"MatricesOfText", kGood, "mote run linear-gaussian --data d.csv --set file=other.toml", 3, R"("F": expected)",
     "F=[[\"a\"]]\nQ=[[1]]\nH=[[1]]\nR=[[1]]\nmean=[0]\ncovariance=[[1]]\n"},
    {"MatricesRagged", kGood, "mote run linear-gaussian --data d.csv --set file=other.toml", 3, "rows of equal length",
     "F=[[1,0],[0]]\nQ=[[1]]\nH=[[1]]\nR=[[1]]\nmean=[0]\ncovariance=[[1]]\n"},
    {"MatricesOfWrongShape", kGood, "mote run linear-gaussian --data d.csv --set file=other.toml", 3, "Q must be 1 x 1",
     "F=[[1]]\nQ=[[1,0],[0,1]]\nH=[[1]]\nR=[[1]]\nmean=[0]\ncovariance=[[1]]\n"},
    {"MatricesAsymmetric", kGood, "mote run linear-gaussian --data d.csv --set file=other.toml", 3,
     "covariance must be symmetric",
     "F=[[1,0],[0,1]]\nQ=[[1,0],[0,1]]\nH=[[1,0]]\nR=[[1]]\nmean=[0,0]\ncovariance=[[1,2],[0,1]]\n"},
    {"NoiseAsymmetric", kGood, kLinear, 3, "Q must be symmetric",
     "F=[[1,0],[0,1]]\nQ=[[1,2],[0,1]]\nH=[[1,0]]\nR=[[1]]\nmean=[0,0]\ncovariance=[[1,0],[0,1]]\n"},
    {"ObservationNoiseZero", kGood, kLinear, 3, "R must be positive definite",
     "F=[[1]]\nQ=[[1]]\nH=[[1]]\nR=[[0]]\nmean=[0]\ncovariance=[[1]]\n"},
    {"MatrixInfinite", kGood, kLinear, 3, "F has an entry that is not a finite number",
     "F=[[inf]]\nQ=[[1]]\nH=[[1]]\nR=[[1]]\nmean=[0]\ncovariance=[[1]]\n"},
    {"NamesWithComma", kGood, kLinear, 3, R"("states": expected different names .*got "a,b")",
     kMatrices + "states=[\"a,b\",\"c\"]\n"},
    {"NamesTwice", kGood, kLinear, 3, R"("states": expected different names .*got "a")",
     kMatrices + "states=[\"a\",\"a\"]\n"},
    {"NamesTooMany", kGood, kLinear, 3, "there must be 1 names of observations",
     kMatrices + "observations=[\"y\",\"z\"]\n"},
    {"JsonBroken", kGood, kJson, 3, R"(o\.json: expected JSON with finite numbers, got parse error at line 1)",
     "{\"F\": [[1"},
    {"JsonOverflow", kGood, kJson, 3, "got number overflow parsing '1e999'", "{\"F\": [[1e999]]}"},
    {"JsonOfOtherKind", kGood, kJson, 3, R"("F": expected a key of that name)", "[1, 2]"},
    {"OutputOverTheData", kGood, "mote run local-level --data d.csv --out ./d.csv", 2,
     R"(d\.csv: expected an output in a file of its own, got a file that this command reads)"},
    {"OutputOverTheMatrices", kGood, "mote simulate linear-gaussian --set file=other.toml --out other.toml", 2,
     "a file that this command reads", kMatrices},
    {"OutputOverTheDataByALink", kGood,
     "ln -s d.csv l.csv; mote run local-level --data d.csv --out l.csv; code=$?; rm l.csv; exit $code", 2,
     "a file that this command reads"},
    {"TwoOutputsOnStandardOutput", kGood, "mote run local-level --data d.csv --out - --summary /dev/stdout", 2,
     "every output in a file of its own"},
    {"FolderTakesNoFiles", kGood, kRun + "--report /proc/r.html", 6, "/proc/r.html: expected an output"},
    {"FileLimit", kGood, "ulimit -f 2; " + kRun + "--dump-particles p.csv", 6, R"(p\.csv: .*File too large)"},
    {"ModelsOnAFullDisk", "", "mote models --json >/dev/full", 6, "standard output: expected.*No space left"},
    {"FiguresOnAFullDisk", kGood, "mote run local-level --data d.csv >/dev/full", 6, "standard output: expected"},
    {"FiguresNowhere", kGood, "mote run local-level --data d.csv >&-", 6, "standard output: expected"},
    {"SimulateOnAFullDisk", "", "mote simulate ungm --truth t.csv --out /dev/full", 6,
     "/dev/full: expected.*No space left"},
    {"FolderOfOutputMissing", kGood, kRun + "--report no/r.html", 6,
     R"(no/r\.html: expected an output that can be written)"},
    {"OutputIsAFolder", kGood, "mkdir f; mote run local-level --data d.csv --out f; code=$?; rmdir f; exit $code", 6,
     "f: expected an output that can be written"},
    {"DiskFull", kGood, kRun + "--dump-particles /dev/full", 6, "/dev/full: expected an output that can be written"},
    {"DiskFullAtTheEnd", kGood, "mote run local-level --data d.csv --out /dev/full --summary s.json", 6, "/dev/full"},
    {"TwoOutputsInOneFile", kGood, "mote run local-level --data d.csv --out x --summary x", 2,
     "every output in a file of its own"},
    {"OutputOverItself", kGood, "mote simulate ungm --out x --truth ./x", 2, "every output in a file of its own"},
};

std::string name_of(const ::testing::TestParamInfo<Case>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Data, Refused, ::testing::ValuesIn(kData), name_of);
INSTANTIATE_TEST_SUITE_P(Use, Refused, ::testing::ValuesIn(kUse), name_of);
INSTANTIATE_TEST_SUITE_P(Files, Refused, ::testing::ValuesIn(kFiles), name_of);

// What may be sent in although it is not pretty.
class Accepted : public ::testing::TestWithParam<Case> {};

TEST_P(Accepted, AndEstimated) {
  const Case& c = GetParam();
  const Scratch scratch;
  scratch.write("d.csv", c.data);
  if (!c.other.empty()) scratch.write("other.toml", c.other);
  const Ended ended = scratch.shell(c.line);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(ended.err.empty() || ended.err.find(": note: ") != std::string::npos) << ended.err;
  const std::string estimates = scratch.read("e.csv") + ended.out;
  EXPECT_TRUE(std::regex_search(estimates, std::regex(c.sentence))) << estimates;
}

const std::vector<Case> kAccepted{
    {"ByteOrderMark", "\xEF\xBB\xBFt,y\n1,1100\n", kRun, 0, "\n1,[0-9]"},
    {"CarriageReturns", "t,y\r\n1,1100\r\n2,1000\r\n", kRun, 0, "\n2,[0-9]"},
    {"BlankLinesAtTheEnd", "t,y\n1,1100\n\n\n", kRun, 0, "\n1,[0-9]"},
    {"NoNewlineAtTheEnd", "t,y\n1,1100", kRun, 0, "\n1,[0-9]"},
    {"QuotedHeader", "\"t\",\"y\"\n1,1100\n", kRun, 0, "\n1,[0-9]"},
    {"Spaces", "t, y\n 1 , 1100 \n", kRun, 0, "\n1,[0-9]"},
    {"EmptyField", "t,y\n1,\n2,1000\n", kRun, 0, "\n2,[0-9]"},
    {"Nan", "t,y\n1,nan\n2,NaN\n", kRun, 0, "\n2,[0-9]"},
    {"Gap", "t,y\n1,1100\n9,1000\n", kRun, 0, "\n9,[0-9]"},
    {"FirstAtFive", "t,y\n5,1100\n", kRun, 0, "\n5,[0-9]"},
    {"SameTimeTwice", "t,y\n1,1100\n1,1000\n2,900\n", kRun, 0, "^t,.*\n1,.*\n2,"},
    {"ExtraColumn", "t,y,comment\n1,1100,hello\n", kRun, 0, "\n1,[0-9]"},
    {"OneParticle", kGood, kRun + "-n 1", 0, "\n2,[0-9]"},
    {"Estimates", kGood, kRun + "--estimate 'q0.9(level)' --estimate 'P(level>1000)' --estimate 'median(level)'", 0,
     R"(log_evidence,q0\.9\(level\),P\(level>1000\),median\(level\))"},
    {"StandardOutput", kGood, "mote run local-level --data d.csv --out -", 0,
     "^t,level_mean,level_sd,ess,log_evidence\n1,"},
    {"Pipe", kGood, "mote run local-level --data d.csv --out /dev/stdout | cat", 0, "^t,level_mean"},
    {"StandardOutputByName", kGood, "mote run local-level --data d.csv --out /dev/stdout | cat", 0,
     R"(^t,level_mean[^l]*level_sd,ess,log_evidence\n1,[^\n]*\n2,[^\n]*\n$)"},
    {"AppendedByTheShell", kGood,
     "echo before >all.csv; mote run local-level --data d.csv --out - >>all.csv; cat all.csv", 0,
     "^before\nt,level_mean"},
    {"NamedPipe", kGood, "mkfifo p; cat p & mote run local-level --data d.csv --out p; wait; test -p p", 0,
     "t,level_mean.*\n1,"},
    {"DataFromAPipe", kGood, "cat d.csv | mote run local-level --data /dev/stdin --out e.csv", 0, "\n2,[0-9]"},
    {"SpacesInEstimates", kGood, kRun + "--estimate 'P(level > 1000)'", 0, R"(log_evidence,P\(level>1000\)\n)"},
    {"NanByAnyName", "t,y\n1,NAN\n2,-nan\n3,NaN\n4,nan\n", kRun, 0, "\n4,[0-9]"},
    {"SignsAndSmallNumbers", "t,y\n+1,+5\n2,1e-400\n3,.5\n4,5.\n", kRun, 0, "\n4,[0-9]"},
    {"LastWordCounts", kGood, kRun + "-n 1000000000 -n 20", 0, "\n2,[0-9]"},
    {"DirectionsAndMore", "t,doa1,doa2,doa_err\n1,0.5,0.6,9\n", "mote run doa --data d.csv --out e.csv", 0, "\n1,0\\."},
    {"OptionsBeforeTheModel", kGood, "mote run --data d.csv --out e.csv local-level", 0, "\n2,[0-9]"},
    {"CollapseKept", "t,y\n1,1e300\n2,1000\n", kRun + "--on-collapse keep", 0, "\n1,.*,-inf\n2,"},
    {"CollapseReset", "t,y\n1,1e300\n2,1000\n", kRun + "--on-collapse reset", 0, "\n1,.*,-inf\n2,"},
    {"Matrices", "t,y\n1,0.5\n", "mote run linear-gaussian --data d.csv --set file=other.toml --out e.csv", 0,
     "t,x1_mean,x1_sd,x2_mean,x2_sd,ess,log_evidence", kMatrices},
    {"Acceptance", kGood, kRun + "--filter imh --improved", 0, "ess,log_evidence,acceptance\n"},
    {"Bearings", "t,bearing,sensor_x,sensor_y,sensor_heading\n1,0.76,0,0,0\n1,0.7,0,0.01,0\n2,0.75,0,0,0\n",
     "mote run bearings --data d.csv --out e.csv", 0,
     "t,x_mean,x_sd,vx_mean,vx_sd,y_mean,y_sd,vy_mean,vy_sd,ess,log_evidence\n1,"},
};

INSTANTIATE_TEST_SUITE_P(Input, Accepted, ::testing::ValuesIn(kAccepted), name_of);

TEST(Outputs, GoToStandardOutputWithoutReplacingItsFile) {
  const Scratch scratch;
  scratch.write("d.csv", kGood);
  const Ended ended = scratch.shell("(echo before; mote run local-level --data d.csv --summary -; echo after) > log");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(std::regex_search(scratch.read("log"), std::regex("^before\n\\{[^]*\\}\nafter\n$")))
      << scratch.read("log");
}

// One seed for both must not make a particle the truth: the simulation has streams of its own.
TEST(Simulation, SharesNoDrawWithAFilterOfTheSameSeed) {
  const Scratch scratch;
  const Ended ended = scratch.shell(
      "mote simulate ungm --steps 3 --seed 5 --out d.csv --truth t.csv && "
      "mote run ungm --data d.csv --seed 5 -n 8 --ess-threshold 0 --dump-particles p.csv && cut -d, -f2 t.csv | tail "
      "-n +2");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::string truth = scratch.read("t.csv");
  const std::string particles = scratch.read("p.csv");
  for (std::size_t at = truth.find('\n') + 1; at < truth.size(); at = truth.find('\n', at) + 1) {
    const std::size_t comma = truth.find(',', at);
    const std::string x = truth.substr(comma, truth.find('\n', at) - comma) + ",";
    EXPECT_EQ(particles.find(x), std::string::npos) << x;
  }
}

struct Note {
  std::string name, line, note;
};

std::ostream& operator<<(std::ostream& out, const Note& n) { return out << n.name; }

class Noted : public ::testing::TestWithParam<Note> {};

TEST_P(Noted, InALine) {
  const Note& n = GetParam();
  const Scratch scratch;
  scratch.write("d.csv", "t,y,z\n1,1100,3\n");
  scratch.write("truth.csv", "t,level\n7,1000\n");
  const Ended ended = scratch.shell(n.line);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.err.find(": note: " + n.note), std::string::npos) << ended.err;
}

const std::vector<Note> kNotes{
    {"Column", kRun, R"(nothing reads the column "z".)"},
    {"TruthOfOtherTimes", kRun + "--truth truth.csv", "no time t of the truth is in the data"},
    {"Chains", kRun + "--chains 2", "--chains is not read: --filter sisr has no chains."},
    {"Groups", kRun + "--filter imh --groups 2", "--groups is not read: --filter imh has no groups."},
    {"Resampler", kRun + "--filter imh --resampler alias", "--resampler is not read: --filter imh does not resample."},
    {"Points", kRun + "--filter sqmc --resampler alias",
     "--resampler is not read: --filter sqmc chooses parents by its points at every step."},
    {"Seed", kRun + "--filter ekf --seed 3", "--seed is not read: --filter ekf draws nothing."},
    {"Precision", kRun + "--filter ukf --precision float", "--precision is not read: --filter ukf computes in double."},
    {"NoExchange", kRun + "--filter distributed --groups 2 --exchange-count 2", "--exchange-count is not read"},
    {"GlobalExchange", kRun + "--filter distributed --groups 2 --group-resampling global --exchange swap",
     "--exchange is not read: --group-resampling global selects over all groups."},
    {"Lookahead", kRun + "--filter auxiliary --parent-weights lookahead --parents sweep", "--parents is not read"},
    {"Columns", "mote simulate ungm --columns 3 --out o.csv", "--columns is not read: ungm has 1 column of its own."},
};

INSTANTIATE_TEST_SUITE_P(Unread, Noted, ::testing::ValuesIn(kNotes), [](const auto& test) { return test.param.name; });

TEST(Runs, SameSeedSameBytesWhateverTheThreads) {
  const Scratch scratch;
  scratch.shell("mote simulate ungm --steps 30 --seed 4 --out d.csv");
  const Ended ended = scratch.shell(
      "mote run ungm --data d.csv --out a.csv --threads 1; mote run ungm --data d.csv --out b.csv --threads 2; mote "
      "run ungm --data d.csv --out c.csv --seed 2");
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(scratch.read("a.csv"), scratch.read("b.csv"));
  EXPECT_NE(scratch.read("a.csv"), scratch.read("c.csv"));
  const std::string imh = "mote run ungm --data d.csv --filter imh --improved --summary s.json --out ";
  EXPECT_EQ(scratch.shell(imh + "a.csv --threads 1; " + imh + "b.csv --threads 2").code, 0);
  EXPECT_EQ(scratch.read("a.csv"), scratch.read("b.csv"));
}

}  // namespace
}  // namespace mote::testing
