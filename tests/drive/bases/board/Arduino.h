// A board that is not there: what the sketch needs of Arduino, and how a test plays the world.
#pragma once
#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

enum { LOW, HIGH };
enum { INPUT, OUTPUT, INPUT_PULLUP };
enum { CHANGE };
const int A0 = 14, PINS = 64;
#define F(text) text
#define constrain(value, least, most) std::min(std::max((value), (least)), (most))

struct Board {
  unsigned long now = 0;
  int level[PINS] = {};
  int pwm[PINS] = {};
  int mode[PINS] = {};
  unsigned long echo = 0;
  void (*handlers[PINS])() = {};
  std::string in, out;
};
inline Board board;

inline bool exists(int pin) { return pin >= 0 && pin < PINS; }
inline unsigned long millis() { return board.now; }
inline void delayMicroseconds(int) {}
inline void noInterrupts() {}
inline void interrupts() {}
inline void pinMode(int pin, int mode) { if (exists(pin)) board.mode[pin] = mode; }
inline int digitalRead(int pin) { return exists(pin) ? board.level[pin] != 0 : 0; }
inline void digitalWrite(int pin, int level) { if (exists(pin)) board.level[pin] = level; }
inline int analogRead(int pin) { return exists(pin) ? board.level[pin] : 0; }
inline void analogWrite(int pin, int value) { if (exists(pin)) board.pwm[pin] = value; }
inline unsigned long pulseIn(int, int, unsigned long most) { return board.echo < most ? board.echo : 0; }
inline int digitalPinToInterrupt(int pin) { return pin; }
inline void attachInterrupt(int pin, void (*handler)(), int) { board.handlers[pin] = handler; }

struct {
  void begin(long) {}
  int available() { return (int)board.in.size(); }
  int read() {
    const char letter = board.in.front();
    board.in.erase(0, 1);
    return (unsigned char)letter;
  }
  void print(char letter) { board.out += letter; }
  void print(long number) { board.out += std::to_string(number); }
  void println(long number) { print(number); board.out += "\r\n"; }
  void println(const char *text) { board.out += text; board.out += "\r\n"; }
} Serial;
