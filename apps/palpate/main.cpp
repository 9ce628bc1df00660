// palpate: one program for the window and the commands.
#include "commands/commands.h"

int main(int argc, char** argv) { return palpate::commands::run(argc, argv); }
