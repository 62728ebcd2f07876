// Ranks: processes that mpirun has started with one command, and that share its work.
//
// Rank 0 hands out the commands of parts, one at a time. Each rank, rank 0 as well, runs its command as a process of its own. At last
// rank 0 joins the parts. Ranks exchange commands and messages alone; the parts are files in a folder that all ranks see.
#pragma once

#include <string>
#include <vector>

namespace steradian::app {

// True if mpirun, or srun with PMIx, has started this process beside others.
bool is_rank();

// Runs the command, the verb and what follows it, with the other ranks. Returns the exit status. A build without MPI says how to get it.
int run_with_ranks(int& argc, char**& argv, const std::vector<std::string>& command);

}  // namespace steradian::app
