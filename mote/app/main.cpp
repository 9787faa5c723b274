#include "mote/app/commands/command.hpp"

int main(int count, char** words) { return mote::run_program(count, words); }
