// sealbench-mpi: the study command on the processes of an MPI job.
//
//   mpirun -n 8 sealbench-mpi study FILE.study [the options of sealbench study]
//
// Every process reads the study and lays out the same points, and every process computes. The first
// process has the store: its main thread hands out samples to whichever process is free, a
// twentieth of a second of them at a time, and writes the answers, while a thread of its own
// computes. A process that dies ends the job, as MPI has it: what was answered is in the store, and
// the same command computes the rest. MPI is linked into this program alone.
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
enum { REASON = SB_ANSWER_REASON, WARNINGS = 2560, STATUS = 1, BLOCK = 64 };

static int processes, stopped; // stopped: how many were told
static bool served;            // another process than the first has asked for samples

static void tell_stop(int process) {
  uint32_t nothing = 0;
  MPI_Send(&nothing, 1, MPI_UINT32_T, process, TAG_STOP, MPI_COMM_WORLD);
  stopped++;
}

// An answer: the sample's number, its status, its figures; why it failed, its warnings.
static void take_answer(SbAnswerSink *sink, const SbQuestions *asked, int source) {
  const int size = (int)(2 + asked->figures);
  g_autofree double *message = g_new(double, (size_t)size);
  char text[REASON + WARNINGS];
  MPI_Recv(message, size, MPI_DOUBLE, source, TAG_ANSWER, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  MPI_Recv(text, sizeof text, MPI_CHAR, source, TAG_ANSWER, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  const size_t sample = (size_t)message[0];
  const SbStoredAnswer answer = {.status = (SbStatus)(int)message[STATUS],
                                 .reason = text[0] != '\0' ? g_strdup(text) : NULL,
                                 .warnings = text[REASON] != '\0' ? g_strdup(text + REASON) : NULL};
  memcpy(sb_answer_place(sink, sample), message + 2, asked->figures * sizeof *message);
  sb_answer_take(sink, sample, answer);
}

// ---- The first process' own samples ----

typedef struct {
  size_t count; // 0: there are no more
  uint32_t sample[BLOCK];
} Block;

typedef struct {
  uint32_t sample;
  SbStoredAnswer answer; // its value, reason and warnings are owned
} Computed;

// A thread that computes and does not use MPI.
typedef struct {
  const SbQuestions *asked;
  GAsyncQueue *work;   // of Block
  GAsyncQueue *result; // of Computed
  GThread *thread;
  size_t waiting, done; // samples that it has been given and not answered; answered
} Own;

static void *compute_own(void *data) {
  Own *own = data;
  SbReport report = {0};
  SbEvaluator *evaluator = NULL;
  const bool good = sb_evaluator_create(&evaluator, &report) == SB_OK;
  for (;;) {
    g_autofree Block *block = g_async_queue_pop(own->work);
    if (block->count == 0) {
      break;
    }
    for (size_t i = 0; i < block->count; i++) {
      Computed *out = g_new0(Computed, 1);
      out->sample = block->sample[i];
      out->answer.value = g_new(double, own->asked->figures + 1);
      out->answer.status =
          good ? sb_answer(&out->answer, evaluator, own->asked, out->sample, NULL, NULL)
               : SB_ERROR_MEMORY;
      g_async_queue_push(own->result, out);
    }
  }
  sb_evaluator_destroy(evaluator);
  return NULL;
}

static void give_own(Own *own, const uint32_t *todo, size_t count) {
  Block *block = g_new0(Block, 1);
  block->count = count;
  if (count > 0) {
    memcpy(block->sample, todo, count * sizeof *todo);
  }
  own->waiting += count;
  g_async_queue_push(own->work, block);
}

// Takes what the thread has computed; how many samples.
static size_t take_own(Own *own, SbAnswerSink *sink) {
  size_t taken = 0;
  for (Computed *out; (out = g_async_queue_try_pop(own->result)) != NULL; taken++) {
    if (out->answer.status == SB_ERROR_MEMORY) {
      MPI_Abort(MPI_COMM_WORLD, SB_EXIT_IO);
    }
    memcpy(sb_answer_place(sink, out->sample), out->answer.value,
           own->asked->figures * sizeof *out->answer.value);
    g_free(out->answer.value);
    out->answer.value = NULL;
    sb_answer_take(sink, out->sample, out->answer);
    g_free(out);
  }
  own->waiting -= taken;
  own->done += taken;
  return taken;
}

static double now(void) {
  return MPI_Wtime();
}

// Samples that the first process has still to hand out.
typedef struct {
  const uint32_t *todo;
  size_t next, count, answered;
  double start;
  bool goes_on;
} Remaining;

// As many as take a twentieth of a second, by what has been answered so far, but not so many that
// another process would have none; 0: there are no more.
static size_t next_block(const Remaining *remaining) {
  const size_t left = remaining->count - remaining->next;
  if (!remaining->goes_on || left == 0) {
    return 0;
  }
  const double each = (now() - remaining->start) * processes / fmax((double)remaining->answered, 1);
  const size_t share = left / (2 * (size_t)processes);
  const double wanted = remaining->answered > 0 ? 0.05 / each : 1;
  return MAX(MIN(share, (size_t)CLAMP(wanted, 1, BLOCK)), 1);
}

// Takes the next message of another process, if there is one.
static bool take_message(SbAnswerSink *sink, const SbQuestions *asked, Remaining *remaining) {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (there && status.MPI_TAG == TAG_ANSWER) {
    take_answer(sink, asked, status.MPI_SOURCE);
    remaining->answered++;
  } else if (there) {
    uint32_t nothing;
    MPI_Recv(&nothing, 1, MPI_UINT32_T, status.MPI_SOURCE, TAG_READY, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    const size_t block = next_block(remaining);
    if (block == 0) {
      tell_stop(status.MPI_SOURCE);
    } else {
      MPI_Send(remaining->todo + remaining->next, (int)block, MPI_UINT32_T, status.MPI_SOURCE,
               TAG_SAMPLE, MPI_COMM_WORLD);
      remaining->next += block;
    }
  }
  return there != 0;
}

static void hand_out(SbAnswerSink *sink, const SbQuestions *asked, const uint32_t *todo,
                     size_t count) {
  Remaining remaining = {.todo = todo, .count = count, .start = now(), .goes_on = true};
  Own own = {.asked = asked, .work = g_async_queue_new(), .result = g_async_queue_new()};
  struct timespec pause = {0, 20000};
  own.thread = g_thread_new("samples", compute_own, &own);
  for (;;) {
    const size_t taken = take_own(&own, sink);
    remaining.answered += taken;
    const size_t block = own.waiting == 0 ? next_block(&remaining) : 0;
    if (block > 0) {
      give_own(&own, todo + remaining.next, block);
      remaining.next += block;
    }
    const bool message = take_message(sink, asked, &remaining);
    remaining.goes_on = remaining.goes_on && sb_answer_poll(sink);
    if (stopped == processes - 1 && own.waiting == 0 && next_block(&remaining) == 0) {
      break;
    }
    // Without a processor of its own while there is nothing to do.
    pause.tv_nsec = taken > 0 || message ? 20000 : MIN(2 * pause.tv_nsec, 1000000);
    if (taken == 0 && !message) {
      nanosleep(&pause, NULL);
    }
  }
  give_own(&own, NULL, 0);
  g_thread_join(own.thread);
  g_async_queue_unref(own.work);
  g_async_queue_unref(own.result);
  sb_cli_note("%d processes: the first computed %zu of %zu samples", processes, own.done,
              remaining.answered);
}

// ---- The other processes ----

static void answer(const SbQuestions *asked, SbEvaluator *evaluator, double *message,
                   uint32_t sample) {
  char text[REASON + WARNINGS] = "";
  SbStoredAnswer out = {.value = message + 2};
  const SbStatus outcome = sb_answer(&out, evaluator, asked, sample, NULL, NULL);
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
      answer(asked, evaluator, message, sample[i]);
    }
  }
  sb_evaluator_destroy(evaluator);
  g_free(message);
}

int main(int argc, char **argv) {
  static const SbAnswerPool first = {.compute = hand_out}, other = {.serve = serve};
  int rank = 0;
  int threads = 0; // only the main thread uses MPI
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
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
