// sealbench-mpi: the study command on the processes of an MPI job.
//
//   mpirun -n 8 sealbench-mpi study FILE.study [the options of sealbench study]
//
// Every process reads the study and lays out the same points. The first has the store, hands out
// samples to whoever is free, a twentieth of a second of them at a time, and writes what they
// answer; alone it computes itself. A process that dies ends the job, as MPI has it: what was
// answered is in the store, and the same command computes the rest. MPI is linked into this program
// alone.
#include "app/cli/cli.h"

#include "app/base/output.h"
#include "app/run/process.h"
#include "app/study/answers.h"

#include <fcntl.h>
#include <math.h>
#include <mpi.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { TAG_READY, TAG_ANSWER, TAG_SAMPLE, TAG_STOP };
// REASON and WARNINGS: bytes of an answer's texts, one behind the other.
enum { REASON = 256, WARNINGS = 2560, STATUS = 1, BLOCK = 64 };

static int processes, stopped; // stopped: how many were told
static bool served;            // another process than the first has asked for samples

static void tell_stop(int process) {
  uint32_t nothing = 0;
  MPI_Send(&nothing, 1, MPI_UINT32_T, process, TAG_STOP, MPI_COMM_WORLD);
  stopped++;
}

// The next message of anybody, without a processor of its own while it waits.
static bool poll(SbAnswerSink *sink, bool *goes_on, MPI_Status *status) {
  int there = 0;
  struct timespec pause = {0, 20000};
  for (;;) {
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, status);
    if (there) {
      return true;
    }
    *goes_on = *goes_on && sb_answer_goes_on(sink);
    nanosleep(&pause, NULL);
    pause.tv_nsec = pause.tv_nsec < 1000000 ? 2 * pause.tv_nsec : 1000000;
  }
}

// An answer: the sample's number, its status, its figures; why it failed, its warnings.
static void take_answer(SbAnswerSink *sink, const SbQuestions *asked, int source) {
  const int size = (int)(2 + asked->figures);
  double *message = g_new(double, (size_t)size);
  char text[REASON + WARNINGS];
  MPI_Recv(message, size, MPI_DOUBLE, source, TAG_ANSWER, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  MPI_Recv(text, sizeof text, MPI_CHAR, source, TAG_ANSWER, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  const size_t sample = (size_t)message[0];
  const SbStoredAnswer answer = {.status = (SbStatus)(int)message[STATUS],
                                 .reason = text[0] != '\0' ? g_strdup(text) : NULL,
                                 .warnings = text[REASON] != '\0' ? g_strdup(text + REASON) : NULL};
  memcpy(sb_answer_place(sink, sample), message + 2, asked->figures * sizeof *message);
  sb_answer_take(sink, sample, answer);
  g_free(message);
}

static double now(void) {
  return MPI_Wtime();
}

static void hand_out(SbAnswerSink *sink, const SbQuestions *asked, const uint32_t *todo,
                     size_t count) {
  size_t next = 0, answered = 0;
  bool goes_on = true;
  const double start = now();
  while (stopped < processes - 1) {
    MPI_Status status;
    poll(sink, &goes_on, &status);
    if (status.MPI_TAG == TAG_ANSWER) {
      take_answer(sink, asked, status.MPI_SOURCE);
      answered++;
      goes_on = goes_on && sb_answer_goes_on(sink);
      continue;
    }
    uint32_t nothing;
    MPI_Recv(&nothing, 1, MPI_UINT32_T, status.MPI_SOURCE, TAG_READY, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    if (next == count || !goes_on) {
      tell_stop(status.MPI_SOURCE);
      continue;
    }
    // What others have answered tells how long one takes.
    const double each = (now() - start) * (processes - 1) / (double)(answered + 1);
    const size_t block = MIN(count - next, (size_t)CLAMP(0.05 / each, 1, BLOCK));
    MPI_Send(todo + next, (int)block, MPI_UINT32_T, status.MPI_SOURCE, TAG_SAMPLE, MPI_COMM_WORLD);
    next += block;
  }
}

static void answer(const SbQuestions *asked, SbEvaluator *evaluator, const SbEvaluator *start,
                   double *message, uint32_t sample) {
  char text[REASON + WARNINGS] = "";
  SbStoredAnswer out = {.value = message + 2};
  const SbStatus outcome = sb_answer(&out, evaluator, asked, start, sample, NULL, NULL);
  if (outcome == SB_ERROR_MEMORY) {
    MPI_Abort(MPI_COMM_WORLD, SB_EXIT_IO);
  }
  g_strlcpy(text, out.reason != NULL ? out.reason : "", REASON);
  g_strlcpy(text + REASON, out.warnings != NULL ? out.warnings : "", WARNINGS);
  message[0] = sample;
  message[STATUS] = (double)outcome;
  MPI_Send(message, (int)(2 + asked->figures), MPI_DOUBLE, 0, TAG_ANSWER, MPI_COMM_WORLD);
  MPI_Send(text, sizeof text, MPI_CHAR, 0, TAG_ANSWER, MPI_COMM_WORLD);
  g_free(out.reason);
  g_free(out.warnings);
}

static void serve(const SbQuestions *asked) {
  SbEvaluator *evaluator = NULL;
  double *message = g_new(double, 2 + asked->figures);
  served = true;
  SbReport report = {0};
  if (sb_evaluator_create(&evaluator, &report) != SB_OK) {
    MPI_Abort(MPI_COMM_WORLD, SB_EXIT_IO);
  }
  SbEvaluator *base = sb_answer_start(asked);
  for (;;) {
    uint32_t sample[BLOCK] = {0};
    int count = 0;
    MPI_Status status;
    MPI_Send(sample, 1, MPI_UINT32_T, 0, TAG_READY, MPI_COMM_WORLD);
    MPI_Recv(sample, BLOCK, MPI_UINT32_T, 0, MPI_ANY_TAG, MPI_COMM_WORLD, &status);
    if (status.MPI_TAG == TAG_STOP) {
      break;
    }
    MPI_Get_count(&status, MPI_UINT32_T, &count);
    for (int i = 0; i < count; i++) {
      answer(asked, evaluator, base, message, sample[i]);
    }
  }
  sb_evaluator_destroy(base);
  sb_evaluator_destroy(evaluator);
  g_free(message);
}

int main(int argc, char **argv) {
  static const SbAnswerPool first = {.compute = hand_out}, other = {.serve = serve};
  int rank = 0;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &processes);
  sb_process_set_up();
  if (rank == 0) {
    sb_output_protect_inputs();
    sb_cli_set_pool(processes > 1 ? &first : NULL);
  } else {
    sb_cli_set_pool(&other);
    // What is wrong with the input the first one says.
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  // Only one command is done by several processes.
  static char name[] = "study";
  const bool named = argc > 1 && strcmp(argv[1], name) == 0;
  argv += named;
  argc -= named;
  argv[0] = name;
  const int code = sb_command_study(argc, argv);
  // Nothing to compute, or a store that cannot be opened: the others wait all the same.
  uint32_t nothing = 0;
  for (int process = 1; rank == 0 && stopped == 0 && process < processes; process++) {
    MPI_Recv(&nothing, 1, MPI_UINT32_T, process, TAG_READY, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    uint32_t end = 0;
    MPI_Send(&end, 1, MPI_UINT32_T, process, TAG_STOP, MPI_COMM_WORLD);
  }
  if (rank != 0 && !served) { // the input is wrong
    MPI_Send(&nothing, 1, MPI_UINT32_T, 0, TAG_READY, MPI_COMM_WORLD);
    MPI_Recv(&nothing, 1, MPI_UINT32_T, 0, TAG_STOP, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  }
  MPI_Finalize();
  return code;
}
