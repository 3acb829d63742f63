// What holds for the whole process, whichever program it is.
#pragma once

// Settings of the libraries below the engine. Once, first thing in main().
void sb_process_set_up(void);
