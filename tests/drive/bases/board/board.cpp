// The sketch as a library for a test.
#include "Arduino.h"

// The Arduino tools declare what a sketch uses before it is defined; so do we.
void reset();
bool is_bumper(int pin);
bool is_kept(int pin);
#include SKETCH

extern "C" {
void board_start() { board = Board(); setup(); }
void board_advance(int milliseconds) { for (; milliseconds > 0; milliseconds--) { board.now++; loop(); } }
void board_receive(const char *data, int size) { board.in.append(data, size); loop(); }
int board_sent(char *data, int most) {
  const int size = std::min(most, (int)board.out.size());
  memcpy(data, board.out.data(), size);
  board.out.erase(0, size);
  return size;
}
void board_set(int pin, int level) { board.level[pin] = level; }
void board_echo(int microseconds) { board.echo = microseconds; }
int board_power(int pin, int direction) { return board.level[direction] ? -board.pwm[pin] : board.pwm[pin]; }
// One edge of the encoder whose first pin this is.
void board_turn(int pin, int other, int is_ahead) {
  board.level[pin] = !board.level[pin];
  board.level[other] = is_ahead ? board.level[pin] : !board.level[pin];
  if (board.handlers[pin]) board.handlers[pin]();
}
}
